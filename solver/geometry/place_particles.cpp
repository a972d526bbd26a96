#include "solver/geometry/place_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solver/case/outline_edges.hpp"
#include "solver/geometry/arrangements.hpp"

namespace porosph {
namespace {

std::vector<Region> regions_of(const std::vector<SoilCase>& soils) {
  std::vector<Region> regions;
  for (const SoilCase& soil : soils) {
    try {
      regions.emplace_back(soil.polygon, soil.holes);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("soil '{}': {}", soil.name, error.what()));
    }
  }
  return regions;
}

void check_apart(const std::vector<SoilCase>& soils, const std::vector<Region>& regions) {
  for (std::size_t a = 0; a < regions.size(); ++a)
    for (std::size_t b = a + 1; b < regions.size(); ++b) {
      const double area = regions[a].overlap(regions[b]);
      if (area > 1e-9 * std::min(regions[a].area(), regions[b].area()))
        throw std::runtime_error(
            fmt::format("soils '{}' and '{}' overlap by {:.4g} m2: cut a hole into one of them",
                        soils[a].name, soils[b].name, area));
    }
}

void check_filled(const Case& scene, const std::vector<CellSite>& sites) {
  std::vector<int> counts(scene.soils.size(), 0);
  for (const CellSite& site : sites) ++counts[site.site.soil];
  for (std::size_t soil = 0; soil < counts.size(); ++soil)
    if (counts[soil] == 0)
      throw std::runtime_error(
          fmt::format("soil '{}' is too thin for particles.spacing = {} m: no particle in it",
                      scene.soils[soil].name, scene.particles.spacing));
}

std::vector<CellSite> arrange(const Case& scene, const std::vector<Region>& regions) {
  const ParticlesCase& particles = scene.particles;
  const Arrangement chosen =
      particles.arrangement == Arrangement::automatic ? arrangement_for(scene) : particles.arrangement;
  const Grid grid = cover(regions, particles.spacing);
  switch (chosen) {
    case Arrangement::fitted:
      return arrange_fitted(grid, regions);
    case Arrangement::disordered:
      return arrange_disordered(grid, regions, particles.disorder, particles.seed);
    case Arrangement::surface:
      return arrange_surface(scene, regions);
    case Arrangement::stretched:
      return arrange_stretched(scene, regions);
    case Arrangement::automatic:
    case Arrangement::lattice:
      break;
  }
  return arrange_lattice(grid, regions);
}

}  // namespace

std::vector<Site> place_particles(const Case& scene) {
  const std::vector<Region> regions = regions_of(scene.soils);
  if (regions.empty()) throw std::runtime_error("the case has no soil");
  check_apart(scene.soils, regions);
  std::vector<CellSite> sites = arrange(scene, regions);
  std::ranges::stable_sort(sites, {}, &CellSite::cell);
  for (CellSite& s : sites)  // the centroid of a cell around a corner of a wall may lie behind it
    s.site.position = regions[s.site.soil].nearest_inside(s.site.position, 0.1 * scene.particles.spacing);
  check_filled(scene, sites);

  std::vector<Site> result;
  result.reserve(sites.size());
  for (const CellSite& site : sites) result.push_back(site.site);
  return result;
}

}  // namespace porosph
