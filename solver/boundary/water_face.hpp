// Water beside a body that it does not enter: a dam's upright face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"
#include "solver/water/still_water.hpp"

namespace porosph {

/// A short piece of a free surface where a stretch of water ends: the water outside presses on it with more
/// (or less) than the pore pressure inside. It moves with the particles around it.
struct WaterFace {
  int outside = -1, inside = -1;               ///< stretch of the water on either side; -1: dry
  std::vector<std::int32_t> particles;         ///< that carry it
  std::vector<double> weight_from, weight_to;  ///< of each: position of the ends, exact for linear fields
};

/// The pieces of the case's free surfaces, where they are at t = 0, at which the stretch outside is not that
/// of the nearest particle. radius: of the particles that carry a piece [m].
std::vector<WaterFace> water_faces(const Case& scene, const Particles& particles, double radius);

/// Adds to the accelerations [m/s2] what the difference of water pressure does at the faces, as they are now:
/// (p_outside - p_inside) n per length, normal to the turned surface. It is shared out by the weights that
/// move the piece, so its force and moment are exact.
void add_water_pressure(std::span<const WaterFace> faces, const Water& water, const Particles& particles,
                        std::span<Vec2> accelerations);

}  // namespace porosph
