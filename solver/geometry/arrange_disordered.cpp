#include <cmath>
#include <random>

#include "solver/geometry/arrangements.hpp"
#include "solver/geometry/voronoi.hpp"

namespace porosph {
namespace {

/// Uniform in [-1, 1); the same numbers on every machine, which std::uniform_real_distribution does not
/// promise.
double draw(std::mt19937_64& random) { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }

void displace(const Grid& grid, const std::vector<Region>& regions, double largest, int seed,
              std::vector<CellSite>& sites) {
  std::vector<std::vector<CellPlace>> places;
  for (const Region& region : regions) places.push_back(place_cells(grid, region, largest));

  std::mt19937_64 random(seed);
  for (auto& [cell, site] : sites) {
    const bool may_leave = places[site.soil][cell] == CellPlace::at_outline;
    Point displaced;
    do {
      const double dx = draw(random), dy = draw(random);
      displaced = site.position + largest * Point(dx, dy);
    } while (may_leave && !regions[site.soil].contains(displaced));
    site.position = displaced;
  }
}

}  // namespace

std::vector<CellSite> arrange_disordered(const Grid& grid, const std::vector<Region>& regions,
                                         double disorder, int seed) {
  std::vector<CellSite> sites = arrange_lattice(grid, regions);
  displace(grid, regions, disorder * grid.spacing, seed, sites);
  for (std::size_t soil = 0; soil < regions.size(); ++soil)
    set_voronoi_areas(grid, regions[soil], static_cast<int>(soil), disorder * grid.spacing, sites);
  return sites;
}

}  // namespace porosph
