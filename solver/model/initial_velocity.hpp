// The motion that a soil starts with.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

/// Velocity at t = 0 of a soil of this density [kg/m3] at a position in it: uniform, turning and bending
/// parts added up [m/s].
Point initial_velocity(const SoilCase& soil, double density, const Point& position);

}  // namespace porosph
