// The ways of placing particles, one soil at a time.
#pragma once

#include <vector>

#include "solver/geometry/grid.hpp"
#include "solver/geometry/place_particles.hpp"

namespace porosph {

/// A site and the lattice cell that it belongs to.
struct CellSite {
  int cell = 0;
  Site site;
};

/// Cells whose centre is inside or on the outline, whole.
std::vector<CellSite> arrange_lattice(const Grid& grid, const Region& region, int soil);

}  // namespace porosph
