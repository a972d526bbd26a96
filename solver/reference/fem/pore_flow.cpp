#include "solver/reference/fem/pore_flow.hpp"

#include <cmath>
#include <limits>

#include "solver/case/pores.hpp"
#include "solver/reference/fem/assemble.hpp"
#include "solver/reference/fem/edges_on_faces.hpp"
#include "solver/reference/fem/elasticity.hpp"
#include "solver/water/flow/default_faces.hpp"

namespace porosph {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Squares = Eigen::Matrix<double, p2::node_count, p2::node_count>;

void number_nodes(const P4Mesh& mesh, PoreFlow& flow) {
  std::vector<int> place(mesh.nodes.size(), -1);
  for (const auto& nodes : mesh.triangles) {
    auto& of_triangle = flow.triangles.emplace_back();
    for (int i = 0; i < p2::node_count; ++i) {
      int& at = place[nodes[p2::in_p4[i]]];
      if (at < 0) at = static_cast<int>(flow.nodes.size()), flow.nodes.push_back(nodes[p2::in_p4[i]]);
      of_triangle[i] = at;
    }
  }
}

struct Parts {
  Triplets opening, storage, conductivity, softness;
};

void add_squares(const Squares& squares, double factor, const std::array<int, p2::node_count>& nodes,
                 Triplets& out) {
  for (int i = 0; i < p2::node_count; ++i)
    for (int j = 0; j < p2::node_count; ++j) out.emplace_back(nodes[i], nodes[j], factor * squares(i, j));
}

/// int P div N of one triangle, for the unknowns that its nodes have.
void add_opening(const std::array<Point, 3>& c, const std::array<int, p4::node_count>& nodes,
                 const std::array<int, p2::node_count>& heads, const Freedoms& freedoms, Triplets& out) {
  const double area = twice_area(c[0], c[1], c[2]) / 2;
  const Eigen::Matrix2d map = gradient_map(c[0], c[1], c[2]);
  for (int a = 0; a < p4::node_count; ++a) {
    Eigen::Matrix<double, 2, p2::node_count> block = Eigen::Matrix<double, 2, p2::node_count>::Zero();
    for (const auto& q : p4::quadrature())
      block += area * q.weight * map * p4::gradients(q.at).col(a) * p2::values(q.at).transpose();
    const NodeFreedom& node = freedoms.nodes[nodes[a]];
    for (int k = 0; k < node.count; ++k)
      for (int j = 0; j < p2::node_count; ++j)
        out.emplace_back(node.unknown[k], heads[j], node.directions.col(k).dot(block.col(j)));
  }
}

void add_triangle(const Case& scene, const SoilCase& soil, const std::array<Point, 3>& c,
                  const std::array<int, p2::node_count>& heads, Parts& parts) {
  const double area = twice_area(c[0], c[1], c[2]) / 2;
  const Eigen::Matrix2d map = gradient_map(c[0], c[1], c[2]);
  Squares mass = Squares::Zero(), flow = Squares::Zero();
  for (const auto& q : p4::quadrature()) {
    const p2::Values n = p2::values(q.at);
    const p2::Gradients g = map * p2::gradients(q.at);
    mass += area * q.weight * n * n.transpose();
    flow += area * q.weight * g.transpose() * soil.permeability.asDiagonal() * g;
  }
  const Lame material = lame(soil);
  const double weight = scene.water.unit_weight;
  add_squares(mass, weight * porosity_of(soil) / scene.water.coupling.bulk_modulus, heads, parts.storage);
  add_squares(mass, weight / (material.lambda + 2 * material.mu), heads, parts.softness);
  add_squares(flow, 1, heads, parts.conductivity);
}

/// Rates and heads of the faces.
void add_faces(const Case& scene, const Mesh& mesh, const P4Mesh& p4mesh, PoreFlow& flow) {
  flow.inflow = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(flow.nodes.size()));
  flow.given.assign(flow.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  if (scene.water.mode != WaterMode::coupled) return;
  const std::vector<HydraulicFaceCase> faces = faces_of_excess(scene);
  const HydraulicOutline outline = hydraulic_outline(scene.soils, faces, shortest_outline_edge(mesh, p4mesh));
  for (const auto& [t, edge] : p4mesh.outline) {
    const std::array<Point, 3> c = corners(mesh, t);
    const Point &from = c[edge], &to = c[(edge + 1) % 3];
    const int named = face_at(outline, (from + to) / 2);
    if (named < 0) continue;
    const HydraulicFaceCase& face = faces[named];
    const std::array<int, 3> along{flow.triangles[t][edge], flow.triangles[t][3 + edge],
                                   flow.triangles[t][(edge + 1) % 3]};
    constexpr std::array<double, 3> simpson{1.0 / 6, 4.0 / 6, 1.0 / 6};  // int P over an edge, exactly
    for (int i = 0; i < 3; ++i) {
      if (face.kind == FaceKind::head) flow.given[along[i]] = face.level;
      if (face.kind == FaceKind::flux) flow.inflow[along[i]] += simpson[i] * (to - from).norm() * face.rate;
    }
  }
}

Eigen::SparseMatrix<double> matrix(std::size_t rows, std::size_t columns, const Triplets& values) {
  Eigen::SparseMatrix<double> m(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  m.setFromTriplets(values.begin(), values.end());
  return m;
}

}  // namespace

PoreFlow assemble_pore_flow(const Case& scene, const Mesh& mesh, const P4Mesh& p4mesh,
                            const Freedoms& freedoms) {
  PoreFlow flow;
  number_nodes(p4mesh, flow);
  Parts parts;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const std::array<Point, 3> c = corners(mesh, t);
    add_opening(c, p4mesh.triangles[t], flow.triangles[t], freedoms, parts.opening);
    add_triangle(scene, scene.soils[mesh.soils[t]], c, flow.triangles[t], parts);
  }
  const std::size_t heads = flow.nodes.size();
  flow.opening = matrix(freedoms.unknowns, heads, parts.opening);
  flow.storage = matrix(heads, heads, parts.storage);
  flow.softness = matrix(heads, heads, parts.softness);
  flow.conductivity = matrix(heads, heads, parts.conductivity);
  add_faces(scene, mesh, p4mesh, flow);
  return flow;
}

}  // namespace porosph
