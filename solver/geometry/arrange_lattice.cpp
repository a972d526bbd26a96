#include "solver/geometry/arrangements.hpp"

namespace porosph {

std::vector<CellSite> arrange_lattice(const Grid& grid, const Region& region, int soil) {
  const std::vector<CellPlace> places = place_cells(grid, region, 1e-6 * grid.spacing);
  std::vector<CellSite> sites;
  for (int cell = 0; cell < grid.cells(); ++cell) {
    if (places[cell] == CellPlace::outside) continue;
    const Point centre = grid.centre(cell);
    if (places[cell] == CellPlace::inside || region.contains(centre))
      sites.push_back({cell, {centre, grid.cell_area(), soil}});
  }
  return sites;
}

}  // namespace porosph
