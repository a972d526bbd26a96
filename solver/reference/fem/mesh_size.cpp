#include "solver/reference/fem/mesh_size.hpp"

#include <algorithm>

#include "solver/reference/fem/rough_points.hpp"

namespace porosph {

double MeshSize::operator()(const Point& p) const {
  double size = h;
  for (const Corner& corner : corners)
    size = std::min(size, std::max(corner.finest, (p - corner.at).norm() / 2));
  return size;
}

MeshSize mesh_size(const Case& scene, const MeshLines& mesh, double h) {
  MeshSize size{h, {}};
  for (const MeshLine& line : mesh.lines) {
    const double length = (mesh.points[line.to] - mesh.points[line.from]).norm();
    if (length >= h) continue;
    for (const int end : {line.from, line.to}) size.corners.push_back({mesh.points[end], length});
  }
  for (const RoughPoint& p : rough_points(scene, mesh)) {
    if (p.kind == RoughPoint::singular) size.corners.push_back({p.at, h / 64});
    if (p.kind == RoughPoint::weak) size.corners.push_back({p.at, h / 8});
  }
  return size;
}

}  // namespace porosph
