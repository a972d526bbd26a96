#include "solver/reference/fem/constraints.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "solver/boundary/support.hpp"
#include "solver/boundary/traction.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

void hold(NodeFreedom& node, const BoundaryCase& boundary) {
  if (support_of(boundary.kind).carries_shear() || node.count == 0) {
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

/// The node goes with the footing into the soil, and not along it where that is rough.
void tie(NodeFreedom& node, const FootingCase& footing, const Point& into, int unknown) {
  const Point along(-into.y(), into.x());
  const auto is_free_along = [&](const Point& d) {
    return node.count == 2 || (node.count == 1 && std::abs(node.directions.col(0).dot(d)) > 1 - 1e-12);
  };
  if (!is_free_along(into))
    throw std::runtime_error(
        fmt::format("finite elements: a boundary holds the ground under footing '{}'", footing.name));
  node.count = footing.rough ? 1 : node.count;
  node.directions << into.x(), along.x(), into.y(), along.y();
  node.unknown[0] = unknown;
}

/// Gives the footings an unknown each, which the nodes under them share.
void tie_to_footings(const Case& scene, const P4Mesh& p4mesh, double tiny, Freedoms& freedoms) {
  for (const FootingCase& footing : scene.footings) {
    if (footing.settlement < never)
      throw std::runtime_error(fmt::format(
          "finite elements: footing '{}' is driven by its settlement; they know only a force", footing.name));
    const Point into = -outward_normal(scene, footing.from, footing.to);
    freedoms.footings.push_back(freedoms.unknowns++);
    for (std::size_t n = 0; n < p4mesh.nodes.size(); ++n)
      if (on_segment(p4mesh.nodes[n], footing.from, footing.to, tiny))
        tie(freedoms.nodes[n], footing, into, freedoms.footings.back());
  }
}

/// The parts of a mesh that can only move as one: triangles that share edges. Parts may still meet in single
/// vertices, about which they can turn.
struct Parts {
  std::vector<int> of_triangle;
  std::vector<int> first_triangle;  ///< per part
};

Parts parts_of(const Mesh& mesh) {
  std::vector<int> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<std::pair<int, int>, int> triangle_at;  // edge -> the first triangle that has it
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto& v = mesh.triangles[t];
    for (int e = 0; e < 3; ++e) {
      const int first = triangle_at.try_emplace(std::minmax(v[e], v[(e + 1) % 3]), t).first->second;
      parent[std::max(root(first), root(t))] = std::min(root(first), root(t));
    }
  }
  Parts parts{std::vector<int>(parent.size()), {}};
  std::vector<int> number(parent.size());
  for (int t = 0; t < static_cast<int>(parent.size()); ++t) {
    if (root(t) == t) {
      number[t] = static_cast<int>(parts.first_triangle.size());
      parts.first_triangle.push_back(t);
    }
    parts.of_triangle[t] = number[root(t)];
  }
  return parts;
}

struct NodeParts {
  std::vector<int> first;                   ///< per node, a part that it belongs to
  std::vector<std::pair<int, int>> hinges;  ///< a node and another part that it belongs to
};

NodeParts parts_at_nodes(const P4Mesh& p4mesh, const Parts& parts) {
  NodeParts at{std::vector<int>(p4mesh.nodes.size(), -1), {}};
  std::set<std::pair<int, int>> known;
  for (std::size_t t = 0; t < p4mesh.triangles.size(); ++t)
    for (const int node : p4mesh.triangles[t]) {
      const int part = parts.of_triangle[t];
      if (at.first[node] < 0) at.first[node] = part;
      if (at.first[node] != part && known.insert({node, part}).second) at.hinges.push_back({node, part});
    }
  return at;
}

std::string motion_name(const Eigen::Vector3d& mode) {
  const Point direction = mode.head<2>();
  if (std::abs(mode[2]) > 1e-6 * direction.norm()) return "turn";
  const Point d = direction.normalized() * (direction.x() + direction.y() < 0 ? -1 : 1);
  return fmt::format("move along ({:.3g}, {:.3g})", d.x() + 0.0, d.y() + 0.0);
}

/// What is held and where parts meet must leave no rigid motion: two translations and a rotation of each part
/// are 3 unknowns, every held direction and every common vertex gives equations for them, and these must have
/// no solution but rest.
void check_rigid_motion(const Mesh& mesh, const P4Mesh& p4mesh, const Freedoms& freedoms) {
  const Parts parts = parts_of(mesh);
  const auto part_count = static_cast<Eigen::Index>(parts.first_triangle.size());
  const auto origin = [&](int part) { return mesh.vertices[mesh.triangles[parts.first_triangle[part]][0]]; };
  const double size = extent(mesh.vertices);
  /// Displacement along d of a node as part of a rigid part.
  const auto along = [&](const Point& d, const Point& node, int part) -> Eigen::Vector3d {
    const Point arm = (node - origin(part)) / size;
    return {d.x(), d.y(), arm.x() * d.y() - arm.y() * d.x()};
  };
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(3 * part_count, 3 * part_count);
  const auto hold_node = [&](int n, int part) {
    for (int k = freedoms.nodes[n].count; k < 2; ++k) {
      const Eigen::Vector3d row = along(freedoms.nodes[n].directions.col(k), p4mesh.nodes[n], part);
      equations.block<3, 3>(3 * part, 3 * part) += row * row.transpose();
    }
  };
  const NodeParts at = parts_at_nodes(p4mesh, parts);
  for (int n = 0; n < static_cast<int>(p4mesh.nodes.size()); ++n) hold_node(n, at.first[n]);
  for (const auto& [n, other] : at.hinges) {
    hold_node(n, other);
    for (const Point& d : {Point(1, 0), Point(0, 1)}) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(3 * part_count);
      row.segment<3>(3 * at.first[n]) = along(d, p4mesh.nodes[n], at.first[n]);
      row.segment<3>(3 * other) = -along(d, p4mesh.nodes[n], other);
      equations += row * row.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(equations);
  const double tiny = 1e-10 * std::max(1.0, modes.eigenvalues().tail<1>()[0]);
  for (int part = 0; part < part_count; ++part)
    for (Eigen::Index m = 0; m < 3 * part_count && modes.eigenvalues()[m] <= tiny; ++m) {
      const Eigen::Vector3d motion = modes.eigenvectors().col(m).segment<3>(3 * part);
      if (motion.norm() < 1e-6) continue;
      const bool hinged = std::any_of(at.hinges.begin(), at.hinges.end(), [&](const auto& hinge) {
        return hinge.second == part || at.first[hinge.first] == part;
      });
      throw std::runtime_error(
          fmt::format("finite elements: no boundary holds the soil around {}: it is free to "
                      "{} as a rigid "
                      "body{}; add a fixed boundary or a roller along its outline",
                      place_text(origin(part)), motion_name(motion),
                      hinged ? ", as it touches the rest in a single point only" : ""));
    }
}

}  // namespace

bool on_segment(const Point& p, const Point& a, const Point& b, double tolerance) {
  const Point along = b - a;
  const double s = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - s * along).norm() <= tolerance;
}

Freedoms constrain(const Case& scene, const Mesh& mesh, const P4Mesh& p4mesh) {
  const double tiny = 1e-8 * extent(mesh.vertices);
  Freedoms freedoms{std::vector<NodeFreedom>(p4mesh.nodes.size()), 0, {}};
  for (std::size_t n = 0; n < p4mesh.nodes.size(); ++n)
    for (const BoundaryCase& boundary : scene.boundaries)
      if (on_segment(p4mesh.nodes[n], boundary.from, boundary.to, tiny)) hold(freedoms.nodes[n], boundary);
  tie_to_footings(scene, p4mesh, tiny, freedoms);
  for (NodeFreedom& node : freedoms.nodes)
    for (int k = 0; k < node.count; ++k)
      if (node.unknown[k] < 0) node.unknown[k] = freedoms.unknowns++;
  check_rigid_motion(mesh, p4mesh, freedoms);
  return freedoms;
}

}  // namespace porosph
