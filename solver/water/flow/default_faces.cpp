#include "solver/water/flow/default_faces.hpp"

#include "solver/case/outline_edges.hpp"

namespace porosph {

std::vector<HydraulicFaceCase> faces_of_excess(const Case& scene) {
  std::vector<HydraulicFaceCase> faces = {{.kind = FaceKind::closed}};
  const std::vector<OutlineEdge> edges = outline_edges(scene.soils);
  for (const OutlineEdge& edge : edges)
    if (is_free(edge, edges, scene.boundaries, 1e-3 * scene.particles.spacing))
      faces.push_back({.kind = FaceKind::head, .from = edge.a, .to = edge.b, .level = 0});
  for (HydraulicFaceCase face : scene.water.faces) {
    if (face.kind == FaceKind::head) face.level -= scene.water.stretches.front().level;
    faces.push_back(face);
  }
  return faces;
}

std::vector<HydraulicFaceCase> faces_of_seepage(const Case& scene) {
  if (scene.water.mode != WaterMode::transient) return scene.water.faces;
  const std::vector<OutlineEdge> edges = outline_edges(scene.soils);
  std::vector<HydraulicFaceCase> faces = {{.kind = FaceKind::closed}};
  for (const OutlineEdge& edge : edges)
    if (is_free(edge, edges, scene.boundaries, 1e-3 * scene.particles.spacing))
      faces.push_back({.kind = FaceKind::seepage, .from = edge.a, .to = edge.b});
  faces.insert(faces.end(), scene.water.faces.begin(), scene.water.faces.end());
  return faces;
}

}  // namespace porosph
