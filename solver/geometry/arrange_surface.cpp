#include <cmath>

#include "solver/geometry/arrangements.hpp"
#include "solver/geometry/bands.hpp"
#include "solver/geometry/clip.hpp"
#include "solver/geometry/moments.hpp"
#include "solver/geometry/slivers.hpp"

namespace porosph {
namespace {

constexpr double sliver = 0.3;      // of a cell: pieces cut off by a slope that are smaller join a neighbour
constexpr double round_off = 1e-9;  // of a cell's area or side

struct Cells {
  std::vector<Band> columns, rows;

  int count(const std::vector<Band>& bands) const { return static_cast<int>(bands.size()); }
  Point middle(int cell) const { return {column(cell).middle, row(cell).middle}; }
  Point low(int cell) const { return {column(cell).low, row(cell).low}; }
  Point high(int cell) const { return {column(cell).high, row(cell).high}; }
  double area(int cell) const { return column(cell).width * row(cell).width; }
  const Band& column(int cell) const { return columns[cell % columns.size()]; }
  const Band& row(int cell) const { return rows[cell / columns.size()]; }

  HalfPlane side(int cell, int side) const {
    const auto [right, up] = cell_sides[side];
    const Band& band = right == 0 ? row(cell) : column(cell);
    return {Point(right, up), right + up < 0 ? -band.low : band.high};
  }
};

/// Whether the rings are one upright rectangle with p inside or on its border: what is left of a cell beside
/// free surfaces through its middle.
bool is_rectangle_around(const Point& p, const std::vector<Polygon>& rings, double area, double tolerance) {
  Point low = rings[0][0], high = low;
  for (const Polygon& ring : rings)
    for (const Point& q : ring) low = low.cwiseMin(q), high = high.cwiseMax(q);
  const bool around = ((p - low).array() >= -tolerance).all() && ((high - p).array() >= -tolerance).all();
  return around && std::abs((high - low).prod() - area) <= tolerance * (high - low).sum();
}

/// What the cells hold of a soil; `at_middle` is set for those whose particle is in the middle of the cell.
Pieces cut_cells(const Cells& cells, const Region& region, double spacing, std::vector<char>& at_middle) {
  Pieces pieces{.all = {},
                .slivers = {},
                .stretches = {},
                .columns = cells.count(cells.columns),
                .rows = cells.count(cells.rows),
                .enough_area = sliver * spacing * spacing,
                .shortest_side = round_off * spacing};
  at_middle.assign(pieces.columns * pieces.rows, false);
  std::vector<Polygon> strip;
  for (int cell = 0; cell < pieces.columns * pieces.rows; ++cell) {
    if (cell % pieces.columns == 0) {
      strip = region.rings();
      clip(strip, cells.side(cell, 0));
      clip(strip, cells.side(cell, 3));
    }
    std::vector<Polygon> rings = strip;
    clip(rings, cells.side(cell, 1));
    clip(rings, cells.side(cell, 2));
    const Point middle = cells.middle(cell);
    const Moments m = moments(rings, middle);
    if (m.area < round_off * cells.area(cell)) continue;
    at_middle[cell] = is_rectangle_around(middle, rings, m.area, 1e-6 * spacing);
    if (at_middle[cell]) {
      pieces.all.push_back({cell, m.area, middle + m.first / m.area});
      continue;
    }
    for (const std::vector<Polygon>& part : parts_of_cell(rings, region, cells.low(cell), cells.high(cell)))
      add_piece(pieces, cell, part, middle, [&](int side) { return cells.side(cell, side); });
  }
  return pieces;
}

Cells cells_of(const Case& scene, const std::vector<Region>& regions, FreeSurfaces free_surfaces) {
  return {bands_along(0, scene, regions, free_surfaces), bands_along(1, scene, regions, free_surfaces)};
}

/// Cuts all soils into cells; place(site, cell, whole, at_middle) settles the site of each piece, `whole` the
/// area of an uncut cell.
template <class Place>
std::vector<CellSite> arrange(const Case& scene, const std::vector<Region>& regions, const Cells& cells,
                              Place&& place) {
  std::vector<CellSite> sites;
  std::vector<char> at_middle;
  for (std::size_t soil = 0; soil < regions.size(); ++soil)
    for (const Piece& piece :
         join_slivers(cut_cells(cells, regions[soil], scene.particles.spacing, at_middle))) {
      Site site{piece.centroid, piece.area, static_cast<int>(soil)};
      place(site, piece.cell, cells.area(piece.cell), at_middle[piece.cell] != 0);
      sites.push_back({piece.cell, site});
    }
  return sites;
}

bool is_whole(const Site& site, double whole) { return std::abs(site.area - whole) < round_off * whole; }

}  // namespace

std::vector<CellSite> arrange_surface(const Case& scene, const std::vector<Region>& regions) {
  const Cells cells = cells_of(scene, regions, FreeSurfaces::in_the_middle);
  return arrange(scene, regions, cells, [&](Site& site, int cell, double whole, bool at_middle) {
    if (!at_middle) return;
    site.position = cells.middle(cell);
    if (is_whole(site, whole)) site.area = whole;  // all alike, to the last bit
    site.fill = site.area / whole;
  });
}

std::vector<CellSite> arrange_stretched(const Case& scene, const std::vector<Region>& regions) {
  const Cells cells = cells_of(scene, regions, FreeSurfaces::at_ends);
  return arrange(scene, regions, cells, [&](Site& site, int cell, double whole, bool) {
    if (is_whole(site, whole)) site.area = whole, site.position = cells.middle(cell);
  });
}

}  // namespace porosph
