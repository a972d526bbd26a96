// Which images behind corners of the outline a particle exchanges water with.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/boundary/soil_outlines.hpp"
#include "solver/particles/particles.hpp"

namespace porosph {

/// Of images of images at the start, as far as one line goes: simpler than WallPaths, which the soil has,
/// since the whole outline is mirrored here.
class OutlineSight {
 public:
  /// `range`: of the kernel; `spacing` of the particles [m].
  OutlineSight(const std::vector<SoilCase>& soils, double range, double spacing)
      : outlines_(soils, spacing), range_(range), spacing_(spacing) {}

  /// Whether the line from particle a to the ghost leaves the soil through one of the stretches that the
  /// ghost is mirrored in.
  bool sees_ghost(std::int32_t a, std::size_t ghost, const Ghosts& ghosts, const Particles& particles) const;

 private:
  bool is_image_in_one_wall(const Vec2& start, std::size_t ghost, const Ghosts& ghosts) const;

  SoilOutlines outlines_;
  double range_, spacing_;
};

}  // namespace porosph
