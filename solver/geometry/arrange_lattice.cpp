#include "solver/geometry/arrangements.hpp"

namespace porosph {

std::vector<CellSite> arrange_lattice(const Grid& grid, const std::vector<Region>& regions) {
  std::vector<CellSite> sites;
  std::vector<bool> taken(grid.cells(), false);
  for (std::size_t soil = 0; soil < regions.size(); ++soil) {
    const std::vector<CellPlace> places = place_cells(grid, regions[soil], 1e-6 * grid.spacing);
    for (int cell = 0; cell < grid.cells(); ++cell) {
      if (places[cell] == CellPlace::outside || taken[cell]) continue;
      const Point centre = grid.centre(cell);
      if (places[cell] == CellPlace::at_outline && !regions[soil].contains(centre)) continue;
      taken[cell] = true;
      sites.push_back({cell, {centre, grid.cell_area(), static_cast<int>(soil)}});
    }
  }
  return sites;
}

}  // namespace porosph
