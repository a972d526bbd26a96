// The ways of placing particles. Each returns the soils' sites one soil after the other.
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

/// Cells whose centre is inside or on the outline. The first soil takes a centre on a common border. All of a
/// soil's have the same area, spacing^2 where the lattice fits the outline: together they carry the soil's.
std::vector<CellSite> arrange_lattice(const Grid& grid, const std::vector<Region>& regions);

/// Cells cut by the outline; slivers of less than 0.45 spacing^2 are joined with the neighbour of the same
/// soil that they share the longest edge with. Area and centroid are those of what results, so that each
/// soil's area and first moments are kept. What a thin wall or slit parts within a cell are pieces
/// of their own.
std::vector<CellSite> arrange_fitted(const Grid& grid, const std::vector<Region>& regions);

/// Sites of arrange_lattice, each displaced at random by up to disorder * spacing in x and in y, but not out
/// of its soil. Areas are those of the Voronoi cells of the soil's sites within the soil.
std::vector<CellSite> arrange_disordered(const Grid& grid, const std::vector<Region>& regions,
                                         double disorder, int seed);

/// Cells with their middle on the free surfaces that lie along the axes, and with their ends at walls and
/// borders of soils (bands_along). Sites are in the middle of cells, fill is the part of the cell that is
/// soil. Where slopes cut the cells, sites and areas are those of the pieces, as with arrange_fitted. The
/// cell of a site counts over these rows and columns.
std::vector<CellSite> arrange_surface(const Case& scene, const std::vector<Region>& regions);

/// Cells with their ends at walls, borders of soils and free surfaces, as far as these lie along the axes:
/// whole cells there, cut where slopes cross them, as with arrange_fitted. The cell of a site counts over
/// these rows and columns.
std::vector<CellSite> arrange_stretched(const Case& scene, const std::vector<Region>& regions);

}  // namespace porosph
