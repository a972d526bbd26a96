// The nodes of 15-node triangles on a mesh: neighbours share those on their common edge.
#pragma once

#include <array>
#include <vector>

#include "solver/reference/fem/mesh.hpp"
#include "solver/reference/fem/p4_triangle.hpp"

namespace porosph {

struct P4Mesh {
  /// An edge that belongs to one triangle only: a piece of the soil's outline.
  struct OutlineEdge {
    int triangle;
    int edge;  ///< from its vertex `edge` to vertex `(edge + 1) % 3`; the soil is on the left
  };
  std::vector<Point> nodes;                                ///< [m]
  std::vector<std::array<int, p4::node_count>> triangles;  ///< node indices in the order of p4::nodes()
  std::vector<OutlineEdge> outline;
};

/// Numbers the nodes: the mesh's vertices first, in their order. Expects a mesh that check_mesh() accepts.
P4Mesh place_nodes(const Mesh&);

}  // namespace porosph
