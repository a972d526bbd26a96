// Which motions the boundaries and footings of a case leave to the nodes of a mesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/reference/fem/p4_mesh.hpp"

namespace porosph {

/// The motion that a node is free to make: displacement = sum over k < count of directions.col(k) times its
/// unknown.
struct NodeFreedom {
  int count = 2;  ///< 0, 1 or 2 unknowns
  Eigen::Matrix2d directions =
      Eigen::Matrix2d::Identity();     ///< orthonormal columns; those after `count` are held
  std::array<int, 2> unknown{-1, -1};  ///< of each free direction; that of a footing belongs to many nodes
};

struct Freedoms {
  std::vector<NodeFreedom> nodes;
  int unknowns = 0;
  std::vector<int> footings;  ///< unknown of each: its settlement into the soil [m]
};

/// Every node on a boundary's segment is held by it: a roller across the segment, a fixed boundary wholly;
/// rollers of different directions add up. Those under a footing move into the soil together, and not along
/// it where it is rough. Throws std::runtime_error if a part of the mesh can still move as a rigid body, and
/// names the motion; a part that meets the rest in one vertex can turn about it. Likewise where a footing is
/// driven by its settlement, or a boundary holds it.
Freedoms constrain(const Case&, const Mesh&, const P4Mesh&);

/// Whether p lies on the segment from a to b, within `tolerance` [m].
bool on_segment(const Point& p, const Point& a, const Point& b, double tolerance);

}  // namespace porosph
