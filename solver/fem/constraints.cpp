#include "solver/fem/constraints.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace porosph {
namespace {

void hold(NodeFreedom& node, const BoundaryCase& boundary) {
  if (boundary.kind == BoundaryKind::fixed || node.count == 0) {
    node.count = 0;
    return;
  }
  const Point along = (boundary.to - boundary.from).normalized();
  const bool same_direction = std::abs(node.directions.col(0).dot(along)) > 1 - 1e-12;
  if (node.count == 1 && !same_direction) node.count = 0;
  if (node.count == 2) {
    node.count = 1;
    node.directions << along.x(), -along.y(), along.y(), along.x();
  }
}

/// Per vertex, one vertex that stands for its connected part of the mesh.
std::vector<int> connected_parts(const Mesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& v : mesh.triangles) {
    parent[root(v[1])] = root(v[0]);
    parent[root(v[2])] = root(v[0]);
  }
  for (int v = 0; v < static_cast<int>(parent.size()); ++v) parent[v] = root(v);
  return parent;
}

std::string motion_name(const Eigen::Vector3d& mode) {
  const Point direction = mode.head<2>();
  if (std::abs(mode[2]) > 1e-6 * direction.norm()) return "turn";
  const Point d = direction.normalized() * (direction.x() + direction.y() < 0 ? -1 : 1);
  return fmt::format("move along ({:.3g}, {:.3g})", d.x() + 0.0, d.y() + 0.0);
}

/// The held directions of a part must exclude both translations and the rotation.
void check_rigid_motion(const Mesh& mesh, const P4Mesh& p4mesh, const Freedoms& freedoms) {
  const std::vector<int> part = connected_parts(mesh);
  std::vector<int> part_of_node(p4mesh.nodes.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int node : p4mesh.triangles[t]) part_of_node[node] = part[mesh.triangles[t][0]];
  const double size = extent(mesh.vertices);
  std::vector<Eigen::Matrix3d> held(mesh.vertices.size(), Eigen::Matrix3d::Zero());
  for (std::size_t n = 0; n < p4mesh.nodes.size(); ++n) {
    const NodeFreedom& node = freedoms.nodes[n];
    const Point arm = (p4mesh.nodes[n] - mesh.vertices[part_of_node[n]]) / size;
    for (int k = node.count; k < 2; ++k) {
      const Point d = node.directions.col(k);
      const Eigen::Vector3d row(d.x(), d.y(), arm.x() * d.y() - arm.y() * d.x());
      held[part_of_node[n]] += row * row.transpose();
    }
  }
  for (const auto& v : mesh.triangles) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(held[part[v[0]]]);
    if (modes.eigenvalues()[0] > 1e-10 * std::max(1.0, modes.eigenvalues()[2])) continue;
    const Point& at = mesh.vertices[v[0]];
    throw std::runtime_error(fmt::format(
        "finite elements: no boundary holds the soil around ({:.4g}, {:.4g}): it is free to {} as a rigid "
        "body; add a fixed boundary or a roller along its outline",
        at.x(), at.y(), motion_name(modes.eigenvectors().col(0))));
  }
}

}  // namespace

bool on_segment(const Point& p, const Point& a, const Point& b, double tolerance) {
  const Point along = b - a;
  const double s = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - s * along).norm() <= tolerance;
}

Freedoms constrain(const std::vector<BoundaryCase>& boundaries, const Mesh& mesh, const P4Mesh& p4mesh) {
  const double tiny = 1e-8 * extent(mesh.vertices);
  Freedoms freedoms{std::vector<NodeFreedom>(p4mesh.nodes.size()), 0};
  for (std::size_t n = 0; n < p4mesh.nodes.size(); ++n) {
    NodeFreedom& node = freedoms.nodes[n];
    for (const BoundaryCase& boundary : boundaries)
      if (on_segment(p4mesh.nodes[n], boundary.from, boundary.to, tiny)) hold(node, boundary);
    node.first_unknown = freedoms.unknowns;
    freedoms.unknowns += node.count;
  }
  check_rigid_motion(mesh, p4mesh, freedoms);
  return freedoms;
}

}  // namespace porosph
