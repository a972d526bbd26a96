#include "solver/reference/fem/demand.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "solver/case/shapes.hpp"
#include "solver/reference/fem/mesh.hpp"
#include "solver/reference/fem/mesh_points.hpp"

namespace porosph {
namespace {

const double area_of_unit_triangle = std::sqrt(3.0) / 4;

double whole_area(const Case& scene) {
  double whole = 0;
  for (const SoilCase& soil : scene.soils) whole += area(soil);
  return whole;
}

// Memory and time: measured from 12,000 to 712,000 unknowns on embankments and rectangles.
FemDemand demand_of(double triangles, double unknowns) {
  return {triangles, unknowns, 8e7 + 2400 * unknowns, 5e-6 * unknowns + 1e-9 * std::pow(unknowns, 1.8)};
}

}  // namespace

FemDemand fem_demand(const Case& scene, double h) {
  if (!(h > 0) || !std::isfinite(h))
    throw std::runtime_error(fmt::format("mesh: edge length is {} m; it must be finite and > 0", h));
  const double fewest = whole_area(scene) / (area_of_unit_triangle * h * h);
  if (!(16 * fewest <= most_fem_unknowns)) return demand_of(fewest, 16 * fewest);
  const MeshLines lines = mesh_lines(scene);
  if (const double longest = extent(lines.points); h > longest)
    throw std::runtime_error(
        fmt::format("mesh: edge length is {:g} m, but the section measures {:.4g} m", h, longest));
  const MeshPoints points = mesh_points(scene, lines, mesh_size(scene, lines, h));
  // Euler: V - E + T = 1, 3 T = 2 E - B; of nodes there are V + 3 E + 3 T.
  const auto vertices = static_cast<double>(points.points.size());
  const auto outline = static_cast<double>(points.edges.size());
  const double triangles = std::max(1.0, 2 * vertices - outline);
  return demand_of(triangles, 2 * (8 * triangles + 2 * outline));
}

double fem_edge(const Case& scene, double triangles) {
  return std::sqrt(whole_area(scene) / (triangles * area_of_unit_triangle));
}

void check_fem_demand(const FemDemand& demand, double bytes) {
  if (demand.unknowns <= most_fem_unknowns && demand.bytes <= bytes) return;
  const std::string limit = demand.unknowns > most_fem_unknowns
                                ? fmt::format("at most {:.0e} unknowns are possible", most_fem_unknowns)
                                : fmt::format("there is {:.3g} GB", bytes / 1e9);
  throw std::runtime_error(fmt::format(
      "finite elements would have about {:.3g} unknowns ({:.3g} triangles), which need about {:.3g} GB "
      "of memory; {}: choose longer edges",
      demand.unknowns, demand.triangles, demand.bytes / 1e9, limit));
}

}  // namespace porosph
