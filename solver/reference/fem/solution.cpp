#include "solver/reference/fem/solution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solver/reference/fem/assemble.hpp"
#include "solver/reference/fem/elasticity.hpp"

namespace porosph {
namespace {

double of_nodes(const std::vector<double>& values, const std::array<int, p4::node_count>& nodes,
                const p4::Barycentric& at) {
  const p4::Values n = p4::values(at);
  double sum = 0;
  for (int i = 0; i < p4::node_count; ++i) sum += values[nodes[i]] * n[i];
  return sum;
}

}  // namespace

FemSolution::FemSolution(const Case& scene, Mesh mesh, P4Mesh nodes, MeshWater water,
                         Eigen::Matrix2Xd displacement)
    : soils_(scene.soils),
      mesh_(std::move(mesh)),
      nodes_(std::move(nodes)),
      water_(std::move(water)),
      displacement_(std::move(displacement)),
      locator_(mesh_) {}

FemPoint FemSolution::at(const Point& p) const {
  const auto hits = locator_.find(mesh_, p);
  if (hits.empty())
    throw std::runtime_error(
        fmt::format("finite elements: the point ({}, {}) is outside the soil", p.x(), p.y()));
  int soil = mesh_.soils[hits.front().triangle];
  for (const auto& hit : hits) soil = std::min(soil, mesh_.soils[hit.triangle]);
  return *in_soil(soil, p);
}

std::optional<FemPoint> FemSolution::in_soil(int soil, const Point& p) const {
  std::vector<FemPoint> readings;
  for (const auto& hit : locator_.find(mesh_, p))
    if (mesh_.soils[hit.triangle] == soil) readings.push_back(in_triangle(hit.triangle, hit.at));
  if (readings.empty()) return std::nullopt;
  return mean(readings);
}

FemPoint FemSolution::in_triangle(int triangle, const p4::Barycentric& at) const {
  const auto& nodes = nodes_.triangles[triangle];
  const auto& v = mesh_.triangles[triangle];
  const Point &a = mesh_.vertices[v[0]], &b = mesh_.vertices[v[1]], &c = mesh_.vertices[v[2]];
  Eigen::Matrix<double, 2, p4::node_count> u;
  for (int i = 0; i < p4::node_count; ++i) u.col(i) = displacement_.col(nodes[i]);

  FemPoint reading;
  reading.soil = mesh_.soils[triangle];
  reading.displacement = u * p4::values(at);
  const Eigen::Matrix2d gradient = u * (gradient_map(a, b, c) * p4::gradients(at)).transpose();
  reading.effective_stress = plane_strain_stress(lame(soils_[reading.soil]), gradient);
  reading.pore_pressure =
      water_.flows()
          ? of_nodes(water_.pore_pressure, nodes, at)
          : water_.triangles[triangle].pore_pressure(at[0] * a.y() + at[1] * b.y() + at[2] * c.y());
  return reading;
}

FemPoint mean(const std::vector<FemPoint>& readings) {
  FemPoint sum;
  for (const FemPoint& r : readings) {
    sum.displacement += r.displacement;
    sum.effective_stress += r.effective_stress;
    sum.pore_pressure += r.pore_pressure;
  }
  const double count = static_cast<double>(readings.size());
  return {sum.displacement / count, sum.effective_stress / count, sum.pore_pressure / count,
          readings.front().soil};
}

}  // namespace porosph
