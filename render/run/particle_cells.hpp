// The part of the soil that each particle stands for, as it is drawn.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph::render {

/// What lies nearest to a particle of its soil, cut by the soil's outline: a polygon about the particle [m].
/// starts: positions at t = 0. Empty for particles whose cell is a whole square, which with `lattice` all
/// are, and for those that did not start in a soil; for all where not all starts are finite.
std::vector<Polygon> particle_cells(const Case& scene, const std::vector<Point>& starts);

}  // namespace porosph::render
