// The points that a mesh is made of: along the lines that it follows, and between them.
#pragma once

#include <array>
#include <vector>

#include "solver/reference/fem/mesh_size.hpp"

namespace porosph {

struct MeshPoints {
  std::vector<Point> points;              ///< [m]
  std::vector<std::array<int, 2>> edges;  ///< pieces of the lines, which must become edges of triangles
};

/// Points along the lines as far apart as `size` says; between them the points of a triangular lattice, finer
/// where `size` asks for it and at least 0.6 of the edge length away from those on the lines.
MeshPoints mesh_points(const Case&, const MeshLines&, const MeshSize& size);

}  // namespace porosph
