#include "solver/reference/fem/assemble.hpp"

#include <Eigen/LU>
#include <cmath>

#include "solver/boundary/traction.hpp"
#include "solver/reference/fem/elasticity.hpp"

namespace porosph {
namespace {

using p4::node_count;
using Corners = std::array<Point, 3>;
using Pairs = Eigen::Matrix<double, node_count, node_count>;
using Vectors = Eigen::Matrix<double, 2, node_count>;  ///< one vector per node

/// Mean over the triangle of d n_a/d l_i * d n_b/d l_j: with straight sides the same for all triangles.
const std::array<std::array<Pairs, 2>, 2>& mean_gradient_products() {
  static const auto means = [] {
    std::array<std::array<Pairs, 2>, 2> m;
    for (auto& row : m) row.fill(Pairs::Zero());
    for (const auto& q : p4::quadrature()) {
      const p4::Gradients g = p4::gradients(q.at);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) m[i][j] += q.weight * g.row(i).transpose() * g.row(j);
    }
    return m;
  }();
  return means;
}

/// blocks[k][l](a, b): force along k at node a for a unit displacement along l at node b.
std::array<std::array<Pairs, 2>, 2> element_stiffness(const Lame& material, const Corners& c) {
  const double area = twice_area(c[0], c[1], c[2]) / 2;
  const Eigen::Matrix2d map = gradient_map(c[0], c[1], c[2]);
  const auto& reference = mean_gradient_products();
  std::array<std::array<Pairs, 2>, 2> products;
  for (int k = 0; k < 2; ++k)
    for (int l = 0; l < 2; ++l) {
      products[k][l].setZero();
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) products[k][l] += area * map(k, i) * map(l, j) * reference[i][j];
    }
  const Pairs laplace = products[0][0] + products[1][1];
  std::array<std::array<Pairs, 2>, 2> blocks;
  for (int k = 0; k < 2; ++k)
    for (int l = 0; l < 2; ++l) {
      blocks[k][l] = material.lambda * products[k][l] + material.mu * products[l][k];
      if (k == l) blocks[k][l] += material.mu * laplace;
    }
  return blocks;
}

/// int rho g . v - int p_w div v
Vectors volume_load(double unit_weight, const TriangleWater& water, const Corners& c) {
  const double area = twice_area(c[0], c[1], c[2]) / 2;
  const Eigen::Matrix2d map = gradient_map(c[0], c[1], c[2]);
  Vectors load = Vectors::Zero();
  for (const auto& q : p4::quadrature()) {
    const double y = q.at[0] * c[0].y() + q.at[1] * c[1].y() + q.at[2] * c[2].y();
    load.row(1) -= area * q.weight * unit_weight * p4::values(q.at).transpose();
    load -= area * q.weight * water.pore_pressure(y) * map * p4::gradients(q.at);
  }
  return load;
}

/// What the nodes of one triangle have.
p4::Values at_nodes(const std::vector<double>& values, const std::array<int, node_count>& nodes) {
  p4::Values of;
  for (int a = 0; a < node_count; ++a) of[a] = values[nodes[a]];
  return of;
}

/// The same of water that flows: the soil weighs as saturated where psi >= 0.
Vectors volume_load(const Case& scene, const SoilCase& soil, const p4::Values& pressure,
                    const p4::Values& pressure_head, const Corners& c) {
  const double area = twice_area(c[0], c[1], c[2]) / 2;
  const Eigen::Matrix2d map = gradient_map(c[0], c[1], c[2]);
  Vectors load = Vectors::Zero();
  for (const auto& q : p4::quadrature()) {
    const p4::Values n = p4::values(q.at);
    const double weight =
        pressure_head.dot(n) >= 0 ? soil.unit_weight_saturated : soil.unit_weight_unsaturated;
    if (scene.loading.gravity_applied) load.row(1) -= area * q.weight * weight * n.transpose();
    load -= area * q.weight * pressure.dot(n) * map * p4::gradients(q.at);
  }
  return load;
}

/// oint p_w n . v over one edge, in `pieces` where p_w has a kink in it; Gauss-Legendre with three points is
/// exact for degree 5. pressure(y, values of the shape functions) [Pa].
template <class Pressure>
Vectors outline_load(Pressure&& pressure, const Corners& c, int edge, int pieces = 1) {
  const Point &from = c[edge], &to = c[(edge + 1) % 3];
  const Point normal_times_length(to.y() - from.y(), from.x() - to.x());
  Vectors load = Vectors::Zero();
  for (int piece = 0; piece < pieces; ++piece)
    for (const double s : {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}) {
      const double weight = (s == 0 ? 4.0 / 9 : 5.0 / 18) / pieces, part = (piece + (1 + s) / 2) / pieces;
      p4::Barycentric at = p4::Barycentric::Zero();
      at[edge] = 1 - part;
      at[(edge + 1) % 3] = part;
      const p4::Values n = p4::values(at);
      load +=
          weight * pressure(from.y() + part * (to.y() - from.y()), n) * normal_times_length * n.transpose();
    }
  return load;
}

/// Of the water that stands beside the soil, where a stretch ends there, or else of that in the triangle.
Vectors outline_load(const Case& scene, const TriangleWater& water, const Corners& c, int edge) {
  constexpr int pieces = 16;  // the level may cross the edge
  const WaterBeside beside = water_beside(scene.water, c[edge], c[(edge + 1) % 3], (c[0] + c[1] + c[2]) / 3,
                                          1e-3 * scene.particles.spacing);
  const auto of = [](const auto& w) {
    return [&w](double y, const p4::Values&) { return w.pore_pressure(y); };
  };
  return beside.stretch != nullptr ? outline_load(of(beside), c, edge, pieces)
                                   : outline_load(of(water), c, edge);
}

/// oint t . v over one edge, t the traction of the loads that it lies on at a time.
Vectors traction_load(const Case& scene, const Corners& c, int edge, double time) {
  const Point &from = c[edge], &to = c[(edge + 1) % 3];
  const double tiny = 1e-6 * scene.particles.spacing;
  const Point normal = Point(to.y() - from.y(), from.x() - to.x()).normalized();
  Vectors load = Vectors::Zero();
  for (const LoadCase& given : scene.loads) {
    if (!on_segment(from, given.from, given.to, tiny) || !on_segment(to, given.from, given.to, tiny))
      continue;
    const Traction traction(given);
    for (const double s : {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}) {
      const double weight = s == 0 ? 4.0 / 9 : 5.0 / 18, part = (1 + s) / 2;
      p4::Barycentric at = p4::Barycentric::Zero();
      at[edge] = 1 - part;
      at[(edge + 1) % 3] = part;
      const Point place = from + part * (to - from);
      load +=
          weight * (to - from).norm() * traction.traction(place, normal, time) * p4::values(at).transpose();
    }
  }
  return load;
}

double unit_weight(const Case& scene, const SoilCase& soil, const TriangleWater& water) {
  if (!scene.loading.gravity_applied) return 0;
  return water.saturated ? soil.unit_weight_saturated : soil.unit_weight_unsaturated;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_stiffness(const std::array<std::array<Pairs, 2>, 2>& blocks,
                   const std::array<int, node_count>& nodes, const Freedoms& freedoms, Triplets& lower) {
  for (int a = 0; a < node_count; ++a)
    for (int b = 0; b < node_count; ++b) {
      const NodeFreedom &at = freedoms.nodes[nodes[a]], &of = freedoms.nodes[nodes[b]];
      Eigen::Matrix2d block;
      block << blocks[0][0](a, b), blocks[0][1](a, b), blocks[1][0](a, b), blocks[1][1](a, b);
      const Eigen::Matrix2d turned = at.directions.transpose() * block * of.directions;
      for (int k = 0; k < at.count; ++k)
        for (int l = 0; l < of.count; ++l) {
          const int row = at.unknown[k], column = of.unknown[l];
          if (row >= column) lower.emplace_back(row, column, turned(k, l));
        }
    }
}

void add_load(const Vectors& element, const std::array<int, node_count>& nodes, const Freedoms& freedoms,
              Eigen::VectorXd& load) {
  for (int a = 0; a < node_count; ++a) {
    const NodeFreedom& node = freedoms.nodes[nodes[a]];
    for (int k = 0; k < node.count; ++k) load[node.unknown[k]] += node.directions.col(k).dot(element.col(a));
  }
}

}  // namespace

Corners corners(const Mesh& mesh, int triangle) {
  const auto& v = mesh.triangles[triangle];
  return {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]};
}

Eigen::VectorXd surface_load(const Case& scene, const Mesh& mesh, const P4Mesh& p4mesh,
                             const Freedoms& freedoms, double time) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(freedoms.unknowns);
  for (const auto& [t, edge] : p4mesh.outline)
    add_load(traction_load(scene, corners(mesh, t), edge, time), p4mesh.triangles[t], freedoms, load);
  for (std::size_t i = 0; i < scene.footings.size(); ++i)
    load[freedoms.footings[i]] += factor_at(scene.footings[i].over_time, time) * scene.footings[i].force;
  return load;
}

Eigen::Matrix2Xd displacements(const Freedoms& freedoms, const Eigen::VectorXd& unknowns) {
  Eigen::Matrix2Xd u = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(freedoms.nodes.size()));
  for (std::size_t n = 0; n < freedoms.nodes.size(); ++n) {
    const NodeFreedom& node = freedoms.nodes[n];
    for (int k = 0; k < node.count; ++k) u.col(n) += unknowns[node.unknown[k]] * node.directions.col(k);
  }
  return u;
}

Eigen::Matrix2d gradient_map(const Point& a, const Point& b, const Point& c) {
  Eigen::Matrix2d sides;
  sides.row(0) = (b - a).transpose();
  sides.row(1) = (c - a).transpose();
  return sides.inverse();
}

LinearSystem assemble(const Case& scene, const Mesh& mesh, const P4Mesh& p4mesh, const MeshWater& water,
                      const Freedoms& freedoms) {
  std::vector<Lame> materials;
  for (const SoilCase& soil : scene.soils) materials.push_back(lame(soil));
  LinearSystem system{Eigen::SparseMatrix<double>(freedoms.unknowns, freedoms.unknowns),
                      Eigen::VectorXd::Zero(freedoms.unknowns)};
  Triplets lower;
  lower.reserve(mesh.triangles.size() * node_count * (2 * node_count + 1));
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Corners c = corners(mesh, t);
    const int soil = mesh.soils[t];
    add_stiffness(element_stiffness(materials[soil], c), p4mesh.triangles[t], freedoms, lower);
    const auto& nodes = p4mesh.triangles[t];
    if (water.flows()) {
      const p4::Values pressure = at_nodes(water.pore_pressure, nodes),
                       psi = at_nodes(water.pressure_head, nodes);
      add_load(volume_load(scene, scene.soils[soil], pressure, psi, c), nodes, freedoms, system.load);
    } else {
      const TriangleWater& here = water.triangles[t];
      add_load(volume_load(unit_weight(scene, scene.soils[soil], here), here, c), nodes, freedoms,
               system.load);
    }
  }
  for (const auto& [t, edge] : p4mesh.outline) {
    const auto& nodes = p4mesh.triangles[t];
    if (water.flows()) {
      const p4::Values pressure = at_nodes(water.pore_pressure, nodes);
      const auto of_nodes = [&](double, const p4::Values& n) { return pressure.dot(n); };
      add_load(outline_load(of_nodes, corners(mesh, t), edge), nodes, freedoms, system.load);
    } else {
      add_load(outline_load(scene, water.triangles[t], corners(mesh, t), edge), nodes, freedoms, system.load);
    }
  }
  system.stiffness.setFromTriplets(lower.begin(), lower.end());
  return system;
}

}  // namespace porosph
