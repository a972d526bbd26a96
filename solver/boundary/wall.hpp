// Walls: straight segments that hold the soil, and the mirror images of particles behind them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/boundary/support.hpp"
#include "solver/case/case.hpp"
#include "solver/space/tensor.hpp"

namespace porosph {

struct Wall {
  BoundaryKind kind = BoundaryKind::fixed;
  double friction = 0;                          ///< shear over normal effective stress that it bears at most
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< [m]
  Vec2 normal = Vec2::Zero();                   ///< unit, towards the soil
  Vec2 shift = Vec2::Zero();  ///< of a periodic one: from the soil at the other side to its image here [m]
  bool bears_weight = false;  ///< stress changes across it: fixed, or gravity acts through it
  bool continued_at_from = false,
       continued_at_to = false;  ///< another wall meets this one there, at an angle
  bool passed_on_at_from = false,
       passed_on_at_to = false;  ///< a later wall, in line with this one, mirrors what lies just at that end

  double distance(const Vec2& p) const {
    return (p - from).dot(normal);
  }  ///< positive on the soil's side [m]
  bool is_periodic() const { return kind == BoundaryKind::periodic; }
  Vec2 mirrored(const Vec2& p) const {
    return is_periodic() ? Vec2(p + shift) : Vec2(p - 2 * distance(p) * normal);
  }
  Mat2 reflection() const { return is_periodic() ? Mat2(Mat2::Identity()) : reflection_in(normal); }
  const Support& support() const { return support_of(kind); }
  /// p lies within `range` [m] in front of the segment, or of what continues it by `beyond` [m] at each end;
  /// of a periodic one, before the other side, however high.
  bool faces(const Vec2& p, double range, double beyond = 0) const;
};

/// The image of a point behind a wall. The parent may itself be an image, of an earlier wall (corners).
struct Image {
  std::int32_t parent;
  std::int32_t wall;
};

/// The particle that each image stems from; the first `particles` parents are not images.
std::vector<std::int32_t> roots(std::span<const Image> images, std::size_t particles);

/// Walls of a case, each facing the soil: what in_soil(place) says beside it or, without an answer, the
/// nearest of `points`. Fixed ones first, then rollers that bear weight, then the others, periodic ones last:
/// each mirrors what those before it made. Throws std::runtime_error where a boundary touches no soil.
std::vector<Wall> make_walls(const std::vector<BoundaryCase>& boundaries, std::span<const Vec2> points,
                             double range, const std::function<bool(const Vec2&)>& in_soil = {});

/// Gives each periodic wall the way from the other one of its pair, where that is among the walls.
void join_sides(std::span<Wall> walls);

/// Appends to `points` the images, in walls `first` to `last - 1`, of all points that face them within
/// `range` and `beyond` [m].
void append_images(std::span<const Wall> walls, std::size_t first, std::size_t last, double range,
                   std::vector<Vec2>& points, std::vector<Image>& images, double beyond = 0);

}  // namespace porosph
