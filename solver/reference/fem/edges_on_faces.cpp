#include "solver/reference/fem/edges_on_faces.hpp"

#include <algorithm>

namespace porosph {

int stretch_beside(const HydraulicOutline& outline, const Point& place) {
  int stretch = -1;
  double nearest = never;
  for (std::size_t s = 0; s < outline.stretches.size(); ++s) {
    const Wall& w = outline.stretches[s];
    const Vec2 line = w.to - w.from;
    const double at = std::clamp((place - w.from).dot(line) / line.squaredNorm(), 0.0, 1.0);
    const double distance = (w.from + at * line - place).norm();
    if (distance < nearest) nearest = distance, stretch = static_cast<int>(s);
  }
  return stretch;
}

int face_at(const HydraulicOutline& outline, const Point& place) {
  const int stretch = stretch_beside(outline, place);
  return outline.patches[outline.patch_at(stretch, outline.along(stretch, place))].face;
}

double shortest_outline_edge(const Mesh& mesh, const P4Mesh& nodes) {
  double shortest = never;
  for (const auto& [triangle, edge] : nodes.outline) {
    const auto& v = mesh.triangles[triangle];
    shortest = std::min(shortest, (mesh.vertices[v[edge]] - mesh.vertices[v[(edge + 1) % 3]]).norm());
  }
  return shortest;
}

}  // namespace porosph
