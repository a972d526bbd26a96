// Ghosts: the images of particles behind walls, and how what particles carry appears there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/wall.hpp"

namespace porosph {

/// How a field of the particles is mirrored in a wall with the reflection R.
enum class Mirrors {
  scalar,     ///< as it is
  direction,  ///< R v
  motion,     ///< what moves with the soil: R v at a roller, -v at a fixed wall, which lets nothing slide
  tensor      ///< R s R
};

/// Ghosts are numbered on after the particles: ghost i of n particles has the number n + i in every array of
/// "particles, then ghosts". A ghost's parent may itself be a ghost, of an earlier wall (corners).
class Ghosts {
 public:
  Ghosts() = default;
  /// Mirrors the particles `points` in the walls `first` to `last - 1`, as far as they lie within `range` [m]
  /// of them, and appends the images to `points`.
  Ghosts(std::span<const Wall> walls, std::size_t first, std::size_t last, double range,
         std::vector<Vec2>& points);
  /// These images of `particles` particles, parents before their children.
  Ghosts(std::span<const Wall> walls, std::vector<Image> images, std::size_t particles);

  std::size_t size() const { return images_.size(); }
  std::size_t particles() const { return particles_; }
  const Image& image(std::size_t i) const { return images_[i]; }
  std::span<const Image> images() const { return images_; }
  std::size_t parent(std::size_t i) const { return static_cast<std::size_t>(images_[i].parent); }
  bool stems_from_ghost(std::size_t i) const { return parent(i) >= particles_; }
  std::int32_t root(std::size_t i) const { return root_[i]; }  ///< the particle that it stems from
  const Wall& wall(std::size_t i) const { return walls_[images_[i].wall]; }
  const Mat2& reflection(std::size_t i) const { return reflection_[images_[i].wall]; }  ///< R

  /// The parent's value as it appears at ghost i.
  template <Mirrors how, class Value>
  Value mirrored(std::size_t i, const Value& value) const {
    if constexpr (how == Mirrors::scalar) return value;
    if constexpr (how == Mirrors::direction) return reflection(i) * value;
    if constexpr (how == Mirrors::motion) return motion_[images_[i].wall] * value;
    if constexpr (how == Mirrors::tensor) return reflection(i) * value * reflection(i);
  }
  /// A flux whose rows move with the soil and whose columns are directions.
  Mat2 mirrored_flux(std::size_t i, const Mat2& flux) const {
    return motion_[images_[i].wall] * flux * reflection(i);
  }

  /// The same from the particle that ghost i stems from, through all walls between them.
  template <Mirrors how, class Value>
  Value from_root(std::size_t i, const Value& value) const {
    return mirrored<how>(i, stems_from_ghost(i) ? from_root<how>(parent(i) - particles_, value) : value);
  }
  Mat2 flux_from_root(std::size_t i, const Mat2& flux) const {
    return mirrored_flux(i, stems_from_ghost(i) ? flux_from_root(parent(i) - particles_, flux) : flux);
  }

  /// Calls use(i) for every ghost from `first` on: those of particles, on all threads, then those of ghosts,
  /// which need their parents.
  template <class Use>
  void for_each(Use&& use, std::size_t first = 0) const {
#pragma omp parallel for schedule(static)
    for (std::size_t i = first; i < images_.size(); ++i)
      if (!stems_from_ghost(i)) use(i);
    for (const std::size_t i : of_ghosts_)
      if (i >= first) use(i);
  }
  /// Appends where they are now to where the particles are [m].
  void fill_positions(std::vector<Vec2>& points) const {
    points.resize(particles_ + size());
    for_each([&](std::size_t i) { points[particles_ + i] = wall(i).mirrored(points[parent(i)]); });
  }
  /// Only those that stem from ghosts.
  std::span<const std::size_t> of_ghosts() const { return of_ghosts_; }

  /// Fills the ghosts' part of a field over particles, then ghosts. get(number) reads a value, set(number,
  /// value) writes it.
  template <Mirrors how, class Get, class Set>
  void fill(Get&& get, Set&& set) const {
    for_each([&](std::size_t i) { set(particles_ + i, mirrored<how>(i, get(parent(i)))); });
  }
  /// The same of an array, which grows by the ghosts where it holds the particles alone.
  template <Mirrors how, class Value>
  void fill(std::vector<Value>& values) const {
    values.resize(particles_ + size());
    fill<how>([&](std::size_t k) -> const Value& { return values[k]; },
              [&](std::size_t k, const Value& value) { values[k] = value; });
  }

 private:
  std::span<const Wall> walls_;
  std::vector<Mat2> reflection_, motion_;  ///< of each wall
  std::size_t particles_ = 0;
  std::vector<Image> images_;
  std::vector<std::int32_t> root_;
  std::vector<std::size_t> of_ghosts_;
};

}  // namespace porosph
