#include <cmath>
#include <random>

#include "solver/geometry/arrangements.hpp"
#include "solver/geometry/voronoi.hpp"

namespace porosph {
namespace {

/// Uniform in [-1, 1); the same numbers on every machine, which std::uniform_real_distribution does not
/// promise.
double draw(std::mt19937_64& random) { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }

void displace(std::vector<CellSite>& sites, const std::vector<Region>& regions, double largest, int seed) {
  std::mt19937_64 random(seed);
  for (auto& [cell, site] : sites) {
    Point displaced;
    do {
      const double dx = draw(random), dy = draw(random);
      displaced = site.position + largest * Point(dx, dy);
    } while (!regions[site.soil].contains(displaced));
    site.position = displaced;
  }
}

}  // namespace

std::vector<CellSite> arrange_disordered(const Grid& grid, const std::vector<Region>& regions,
                                         double disorder, int seed) {
  std::vector<CellSite> sites = arrange_lattice(grid, regions);
  displace(sites, regions, disorder * grid.spacing, seed);
  for (std::size_t soil = 0; soil < regions.size(); ++soil)
    set_voronoi_areas(grid, regions[soil], static_cast<int>(soil), disorder * grid.spacing, sites);
  return sites;
}

}  // namespace porosph
