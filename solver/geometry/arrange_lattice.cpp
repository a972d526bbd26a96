#include <cmath>
#include <span>

#include "solver/geometry/arrangements.hpp"

namespace porosph {
namespace {

/// Gives each site its share of the soil's area. A lattice that fits keeps its cells' to the last bit.
void carry_area(double area, double of_cell, std::span<CellSite> sites) {
  const double share = area / static_cast<double>(sites.size());
  if (std::abs(share - of_cell) <= 1e-9 * of_cell) return;
  for (CellSite& site : sites) site.site.area = share;
}

}  // namespace

std::vector<CellSite> arrange_lattice(const Grid& grid, const std::vector<Region>& regions) {
  std::vector<CellSite> sites;
  std::vector<bool> taken(grid.cells(), false);
  for (std::size_t soil = 0; soil < regions.size(); ++soil) {
    const std::size_t first = sites.size();
    const std::vector<CellPlace> places = place_cells(grid, regions[soil], 1e-6 * grid.spacing);
    for (int cell = 0; cell < grid.cells(); ++cell) {
      if (places[cell] == CellPlace::outside || taken[cell]) continue;
      const Point centre = grid.centre(cell);
      if (places[cell] == CellPlace::at_outline && !regions[soil].contains(centre)) continue;
      taken[cell] = true;
      sites.push_back({cell, {centre, grid.cell_area(), static_cast<int>(soil)}});
    }
    carry_area(regions[soil].area(), grid.cell_area(), std::span(sites).subspan(first));
  }
  return sites;
}

}  // namespace porosph
