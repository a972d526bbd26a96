#include "render/run/particle_cells.hpp"

#include <algorithm>
#include <cmath>

#include "solver/geometry/clip.hpp"
#include "solver/geometry/grid.hpp"
#include "solver/geometry/moments.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph::render {
namespace {

constexpr double reach = 3;  // of neighbours that may cut a cell, in spacings; a cell reaches half as far

std::vector<Region> regions_of(const Case& scene) {
  std::vector<Region> regions;
  for (const SoilCase& soil : scene.soils) regions.emplace_back(soil.polygon, soil.holes);
  return regions;
}

int soil_at(const std::vector<Region>& regions, const Point& p) {
  const auto found = std::ranges::find_if(regions, [&](const Region& region) { return region.contains(p); });
  return found == regions.end() ? -1 : static_cast<int>(found - regions.begin());
}

/// Whether the outline of a region passes near the particle, so that its cell, or its neighbour's, is cut.
std::vector<char> are_near_outline(const std::vector<Region>& regions, const std::vector<Point>& starts,
                                   double spacing) {
  const Grid grid = cover(regions, spacing);
  std::vector<char> near(starts.size(), false);
  for (const Region& region : regions) {
    const std::vector<CellPlace> places = place_cells(grid, region, 1.5 * spacing);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Point at = (starts[i] - grid.origin) / spacing;
      const int column = std::clamp(static_cast<int>(at.x()), 0, grid.columns - 1);
      const int row = std::clamp(static_cast<int>(at.y()), 0, grid.rows - 1);
      near[i] = near[i] || places[grid.cell(column, row)] == CellPlace::at_outline;
    }
  }
  return near;
}

/// The largest of the rings, about p.
Polygon largest_about(const Point& p, const std::vector<Polygon>& rings) {
  Polygon largest;
  double most = 0;
  for (const Polygon& ring : rings)
    if (const double area = moments({ring}, p).area; area > most) {
      largest = ring;
      most = area;
    }
  for (Point& corner : largest) corner -= p;
  return largest;
}

Polygon cell_of(const Point& p, std::vector<Polygon> rings, const std::vector<Point>& neighbours,
                double spacing) {
  for (const Point& normal : {Point(1, 0), Point(-1, 0), Point(0, 1), Point(0, -1)})
    clip(rings, {normal, normal.dot(p) + 0.5 * reach * spacing});
  for (const Point& other : neighbours)
    if (const Point towards = other - p; towards.squaredNorm() > 0)
      clip(rings, {towards, towards.dot(p + 0.5 * towards)});
  return largest_about(p, rings);
}

}  // namespace

std::vector<Polygon> particle_cells(const Case& scene, const std::vector<Point>& starts) {
  std::vector<Polygon> cells(starts.size());
  const Arrangement arrangement = scene.particles.arrangement;
  const auto finite = [](const Point& p) { return p.allFinite(); };
  if (arrangement == Arrangement::lattice || !std::ranges::all_of(starts, finite)) return cells;

  const std::vector<Region> regions = regions_of(scene);
  const double spacing = scene.particles.spacing;
  std::vector<std::size_t> cut;
  std::vector<Point> places;
  const std::vector<char> near_outline = are_near_outline(regions, starts, spacing);
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (near_outline[i] || arrangement != Arrangement::fitted) {
      cut.push_back(i);
      places.push_back(starts[i]);
    }
  const NeighbourList list = find_neighbours(places, starts, reach * spacing);
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const int soil = soil_at(regions, places[k]);
    if (soil < 0) continue;
    std::vector<Point> neighbours;
    for (const std::int32_t j : list.of(k))
      if (regions[soil].contains(starts[j])) neighbours.push_back(starts[j]);
    cells[cut[k]] = cell_of(places[k], regions[soil].rings(), neighbours, spacing);
  }
  return cells;
}

}  // namespace porosph::render
