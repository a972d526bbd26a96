// Water beside a body that it does not enter: a dam's upright face.
#pragma once

#include <vector>

#include "solver/boundary/load.hpp"
#include "solver/case/case.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {

/// On a free surface where a stretch of water ends: the water outside presses on it with more (or less) than
/// the pore pressure inside.
class WaterOnFace final : public Load {
 public:
  /// Stretches of the water on either side; -1: dry.
  WaterOnFace(const WaterCase& water, int outside, int inside)
      : standing_(water), outside_(outside), inside_(inside) {}

  int outside() const { return outside_; }
  Vec2 traction(const Vec2& place, const Vec2& normal, double time) const override;

 private:
  StandingWater standing_;
  int outside_, inside_;
};

/// The pieces of the case's free surfaces, where they are at t = 0, at which the stretch outside is not that
/// of the nearest particle, each under its water. radius: of the particles that carry a piece [m].
std::vector<LoadedSurface> water_faces(const Case& scene, const Particles& particles, double radius);

}  // namespace porosph
