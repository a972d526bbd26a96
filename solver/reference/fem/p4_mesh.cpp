#include "solver/reference/fem/p4_mesh.hpp"

#include <algorithm>
#include <map>

namespace porosph {
namespace {

struct SharedEdge {
  int first_node = -1;  ///< its three inner nodes, counted from the lower vertex index
  int users = 0;
  P4Mesh::OutlineEdge last_user{};
};

}  // namespace

P4Mesh place_nodes(const Mesh& mesh) {
  constexpr int per_edge = p4::order - 1;
  P4Mesh p4mesh{mesh.vertices, std::vector<std::array<int, p4::node_count>>(mesh.triangles.size()), {}};
  std::map<std::array<int, 2>, SharedEdge> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    auto& nodes = p4mesh.triangles[t];
    std::copy(v.begin(), v.end(), nodes.begin());
    for (int e = 0; e < 3; ++e) {
      const int from = v[e], to = v[(e + 1) % 3], low = std::min(from, to), high = std::max(from, to);
      SharedEdge& edge = edges[{low, high}];
      if (edge.users == 0) {
        edge.first_node = static_cast<int>(p4mesh.nodes.size());
        for (int i = 1; i <= per_edge; ++i)
          p4mesh.nodes.push_back(mesh.vertices[low] +
                                 (mesh.vertices[high] - mesh.vertices[low]) * i / p4::order);
      }
      ++edge.users;
      edge.last_user = {static_cast<int>(t), e};
      for (int i = 0; i < per_edge; ++i)
        nodes[3 + per_edge * e + i] = edge.first_node + (from == low ? i : per_edge - 1 - i);
    }
    for (int i = 3 + 3 * per_edge; i < p4::node_count; ++i) {
      nodes[i] = static_cast<int>(p4mesh.nodes.size());
      const p4::Barycentric& l = p4::nodes()[i];
      p4mesh.nodes.push_back(l[0] * mesh.vertices[v[0]] + l[1] * mesh.vertices[v[1]] +
                             l[2] * mesh.vertices[v[2]]);
    }
  }
  for (const auto& [vertices, edge] : edges)
    if (edge.users == 1) p4mesh.outline.push_back(edge.last_user);
  return p4mesh;
}

}  // namespace porosph
