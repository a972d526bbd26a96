#include "solver/geometry/arrangements.hpp"
#include "solver/geometry/clip.hpp"
#include "solver/geometry/moments.hpp"
#include "solver/geometry/slivers.hpp"

namespace porosph {
namespace {

// Smaller pieces join a neighbour. Near one half, so that an outline keeps the particles whose cell centre
// lies inside, as on the plain lattice; not one half itself, which would depend on round-off: it is what a
// slope through the cells' corners cuts off. Areas reach 1.8 cells; at 0.35 only 1.4, but the stress comes
// out no better.
constexpr double sliver = 0.45;
constexpr double round_off = 1e-9;  // of a cell's area or side

HalfPlane side_of_cell(const Grid& grid, int cell, int side) {
  const Point normal(cell_sides[side][0], cell_sides[side][1]);
  return {normal, normal.dot(grid.centre(cell)) + grid.spacing / 2};
}

void cut_cell(const Grid& grid, int cell, const Region& region, std::vector<Polygon> row, Pieces& pieces) {
  clip(row, side_of_cell(grid, cell, 1));
  clip(row, side_of_cell(grid, cell, 2));
  const Point centre = grid.centre(cell);
  const Moments m = moments(row, centre);
  const double fraction = m.area / grid.cell_area();
  if (fraction < round_off) return;
  if (fraction > 1 - round_off) {
    pieces.all.push_back({cell, grid.cell_area(), centre});
    return;
  }
  const Point half = Point::Constant(grid.spacing / 2);
  for (const std::vector<Polygon>& part : parts_of_cell(row, region, centre - half, centre + half))
    add_piece(pieces, cell, part, centre, [&](int side) { return side_of_cell(grid, cell, side); });
}

Pieces cut_cells(const Grid& grid, const Region& region) {
  const std::vector<CellPlace> places = place_cells(grid, region, 1e-6 * grid.spacing);
  Pieces pieces{.all = {},
                .slivers = {},
                .stretches = {},
                .columns = grid.columns,
                .rows = grid.rows,
                .enough_area = sliver * grid.cell_area(),
                .shortest_side = round_off * grid.spacing};
  for (int row = 0; row < grid.rows; ++row) {
    std::vector<Polygon> strip = region.rings();
    clip(strip, side_of_cell(grid, grid.cell(0, row), 0));
    clip(strip, side_of_cell(grid, grid.cell(0, row), 3));
    for (int cell = grid.cell(0, row); cell < grid.cell(0, row + 1); ++cell) {
      if (places[cell] == CellPlace::at_outline) cut_cell(grid, cell, region, strip, pieces);
      if (places[cell] == CellPlace::inside)
        pieces.all.push_back({cell, grid.cell_area(), grid.centre(cell)});
    }
  }
  return pieces;
}

}  // namespace

std::vector<CellSite> arrange_fitted(const Grid& grid, const std::vector<Region>& regions) {
  std::vector<CellSite> sites;
  for (std::size_t soil = 0; soil < regions.size(); ++soil)
    for (const Piece& piece : join_slivers(cut_cells(grid, regions[soil])))
      sites.push_back({piece.cell, {piece.centroid, piece.area, static_cast<int>(soil)}});
  return sites;
}

}  // namespace porosph
