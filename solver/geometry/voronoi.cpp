#include "solver/geometry/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/geometry/clip.hpp"
#include "solver/geometry/moments.hpp"

namespace porosph {
namespace {

/// Where the sites of a soil are, by lattice cell.
struct SitesOnGrid {
  const Grid& grid;
  double largest_displacement = 0;
  const std::vector<CellSite>& sites;
  std::vector<int> site_of_cell;  // -1 where there is none
};

double farthest_vertex(const std::vector<Polygon>& rings, const Point& p) {
  double farthest = 0;
  for (const Polygon& ring : rings)
    for (const Point& vertex : ring) farthest = std::max(farthest, (vertex - p).squaredNorm());
  return std::sqrt(farthest);
}

/// Cuts away what is nearer to the site of another cell.
void clip_at_bisector(const SitesOnGrid& on_grid, const Point& p, int column, int row,
                      std::vector<Polygon>& rings, double& radius) {
  if (!on_grid.grid.has(column, row)) return;
  const int other = on_grid.site_of_cell[on_grid.grid.cell(column, row)];
  if (other < 0) return;
  const Point towards = on_grid.sites[other].site.position - p;
  if (towards.norm() >= 2 * radius) return;
  clip(rings, {towards, towards.dot(p + towards / 2)});
  radius = farthest_vertex(rings, p);
}

/// Cuts by the sites of ever wider squares of cells, until none can be near enough to matter.
double voronoi_area(const SitesOnGrid& on_grid, const CellSite& site, std::vector<Polygon> rings) {
  const Grid& grid = on_grid.grid;
  const Point& p = site.site.position;
  const int column = grid.column(site.cell), row = grid.row(site.cell);
  double radius = farthest_vertex(rings, p);
  for (int k = 1; k < std::max(grid.columns, grid.rows); ++k) {
    if (k * grid.spacing - 2 * on_grid.largest_displacement >= 2 * radius) break;
    for (int i = -k; i < k; ++i) {
      clip_at_bisector(on_grid, p, column + i, row - k, rings, radius);
      clip_at_bisector(on_grid, p, column + k, row + i, rings, radius);
      clip_at_bisector(on_grid, p, column - i, row + k, rings, radius);
      clip_at_bisector(on_grid, p, column - k, row - i, rings, radius);
    }
  }
  return moments(rings, p).area;
}

Polygon square(const Point& centre, double half) {
  return {centre + Point(-half, -half), centre + Point(half, -half), centre + Point(half, half),
          centre + Point(-half, half)};
}

}  // namespace

void set_voronoi_areas(const Grid& grid, const Region& region, int soil, double largest_displacement,
                       std::vector<CellSite>& sites) {
  SitesOnGrid on_grid{grid, largest_displacement, sites, std::vector<int>(grid.cells(), -1)};
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (sites[i].site.soil == soil) on_grid.site_of_cell[sites[i].cell] = static_cast<int>(i);

  // No point of a cell is farther than this from the cell's site, so no Voronoi cell reaches farther either,
  // unless cells without a site are near: those are at the outline.
  const double displacement = std::numbers::sqrt2 * largest_displacement;
  const double reach = grid.spacing / std::numbers::sqrt2 + displacement;
  const std::vector<CellPlace> places = place_cells(grid, region, displacement + reach + grid.spacing);

#pragma omp parallel for schedule(dynamic, 256)
  for (CellSite& site : sites) {
    if (site.site.soil != soil) continue;
    const bool near_outline = places[site.cell] == CellPlace::at_outline;
    site.site.area =
        voronoi_area(on_grid, site,
                     near_outline ? region.rings() : std::vector<Polygon>{square(site.site.position, reach)});
  }
}

}  // namespace porosph
