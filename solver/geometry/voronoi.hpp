// Which part of a soil is nearest to which particle.
#pragma once

#include <vector>

#include "solver/geometry/arrangements.hpp"

namespace porosph {

/// Sets the area of the sites of one soil to that of their Voronoi cells, cut by the soil's outline.
/// largest_displacement: of a site from its lattice cell's centre, in x and in y [m]; at most one site per
/// cell.
void set_voronoi_areas(const Grid& grid, const Region& region, int soil, double largest_displacement,
                       std::vector<CellSite>& sites);

}  // namespace porosph
