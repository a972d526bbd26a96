// Water that flows, as pictures show it: what stands outside the soil, and the water table in it.
#pragma once

#include <span>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph::render {

/// The water beside the faces of a case that have a head, as far as it stands above the soil.
std::vector<WaterStretch> water_beside_faces(const Case& scene);

/// Lines on which the pressure head falls through zero, from left to right: in each column of particles, one
/// spacing wide, the highest place below which it is wet. `positions` and `pressure_head` in m.
std::vector<std::vector<Point>> water_table(std::span<const Point> positions,
                                            std::span<const double> pressure_head, double spacing);

}  // namespace porosph::render
