// Which particles and images water passes between.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"
#include "solver/water/flow/outline.hpp"
#include "solver/water/flow/outline_sight.hpp"

namespace porosph {

/// A pair before its conductance is known. `to` counts particles, then images.
struct FlowLink {
  std::int32_t from, to;
  Vec2 x;    ///< from one to the other [m]
  double f;  ///< V_b F_ab [1/m2]
};

/// Links particles with those that they see within the kernel's reach, without leaving the soil, and with the
/// images that the outline mirrors.
class FlowLinks {
 public:
  static constexpr double on_outline = 1e-6;  ///< spacings within which a point lies on it

  /// `as_drawn`: the soil lies in its outline as drawn, all of which mirrors it.
  FlowLinks(const std::vector<SoilCase>& soils, const HydraulicOutline& outline, const Particles& particles,
            double spacing, bool as_drawn);

  std::size_t particles() const { return p_.size(); }
  std::span<const FlowLink> of(std::size_t a) const {
    return {links_.data() + begin_[a], links_.data() + begin_[a + 1]};
  }
  const Ghosts& ghosts() const { return ghosts_; }
  const Vec2& place(std::size_t point) const { return points_[point]; }
  double cell(std::size_t point) const { return cell_[point]; }         ///< whole [m2]
  double volume(std::size_t a) const { return p_.fill[a] * cell_[a]; }  ///< [m2]
  /// The particle that a point is, or is the image of.
  std::int32_t root(std::int32_t point) const {
    return is_particle(point) ? point : ghosts_.root(point - particles());
  }
  /// What a point has of a tensor or a direction of its root.
  Mat2 reflected(std::int32_t point, const Mat2& m) const {
    return is_particle(point) ? m : ghosts_.from_root<Mirrors::tensor>(point - particles(), m);
  }
  Vec2 reflected(std::int32_t point, const Vec2& v) const {
    return is_particle(point) ? v : ghosts_.from_root<Mirrors::direction>(point - particles(), v);
  }

 private:
  bool is_particle(std::int32_t point) const { return static_cast<std::size_t>(point) < particles(); }
  void link(const OutlineSight& sight, const CubicSpline<2>& kernel);
  int first_stretch_between(const Vec2& from, const Vec2& to) const;
  bool is_beside_its_stretch(std::size_t ghost) const;
  bool sees_ghost(const OutlineSight& sight, std::int32_t a, std::size_t ghost) const;
  bool lies_on_mirror(std::int32_t a, std::size_t ghost) const;

  const HydraulicOutline& outline_;
  const Particles& p_;
  double spacing_;
  bool as_drawn_;
  std::vector<Vec2> points_;  ///< particles, then images
  Ghosts ghosts_;
  std::vector<double> cell_;  ///< whole cells of particles and images [m2]
  std::vector<FlowLink> links_;
  std::vector<std::int64_t> begin_;
};

}  // namespace porosph
