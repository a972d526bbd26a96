// Which motions the boundaries of a case leave to the nodes of a mesh.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/reference/fem/p4_mesh.hpp"

namespace porosph {

/// The motion that a node is free to make: displacement = directions.leftCols(count) * unknowns.
struct NodeFreedom {
  int count = 2;  ///< 0, 1 or 2 unknowns
  Eigen::Matrix2d directions =
      Eigen::Matrix2d::Identity();  ///< orthonormal columns; those after `count` are held
  int first_unknown = 0;
};

struct Freedoms {
  std::vector<NodeFreedom> nodes;
  int unknowns = 0;
};

/// Every node on a boundary's segment is held by it: a roller across the segment, a fixed boundary wholly;
/// rollers of different directions add up. Throws std::runtime_error if a part of the mesh can still
/// move as a rigid body, and names the motion; a part that meets the rest in one vertex can turn about it.
Freedoms constrain(const std::vector<BoundaryCase>&, const Mesh&, const P4Mesh&);

/// Whether p lies on the segment from a to b, within `tolerance` [m].
bool on_segment(const Point& p, const Point& a, const Point& b, double tolerance);

}  // namespace porosph
