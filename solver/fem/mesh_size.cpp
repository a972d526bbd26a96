#include "solver/fem/mesh_size.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/fem/constraints.hpp"
#include "solver/fem/mesh.hpp"

namespace porosph {
namespace {

enum class Held { no, roller, fixed };

Held held(const std::vector<BoundaryCase>& boundaries, const Point& a, const Point& b, double tiny) {
  Held strongest = Held::no;
  for (const BoundaryCase& boundary : boundaries)
    if (on_segment(a, boundary.from, boundary.to, tiny) && on_segment(b, boundary.from, boundary.to, tiny))
      strongest = std::max(strongest, boundary.kind == BoundaryKind::fixed ? Held::fixed : Held::roller);
  return strongest;
}

enum class Strength { regular, weak, singular };

/// A roller is a mirror for an otherwise free or fixed neighbour, so the angle inside the soil counts twice
/// there.
Strength strength(Held one, Held other, double angle) {
  constexpr double straight = std::numbers::pi, slack = std::numbers::pi / 18;
  if (one == other && std::abs(angle - straight) <= slack) return Strength::regular;
  if ((one == Held::roller) != (other == Held::roller))
    return 2 * angle > straight + slack ? Strength::singular : Strength::regular;
  if (one == Held::roller) return angle > straight / 2 + slack ? Strength::singular : Strength::regular;
  if (one != other) return Strength::singular;
  if (angle > straight + slack) return Strength::singular;
  return one == Held::no ? Strength::weak : Strength::regular;
}

/// A line of the outline as seen from a point that it ends in.
struct Spoke {
  Point direction;
  bool soil_on_left;
  Held is_held;
};

Strength strength(const std::vector<Spoke>& spokes) {
  if (spokes.size() != 2) return Strength::singular;  // parts of the outline touch in this point
  const Spoke& start = spokes[spokes[0].soil_on_left ? 0 : 1];
  const Spoke& end = spokes[spokes[0].soil_on_left ? 1 : 0];
  const double cross = start.direction.x() * end.direction.y() - start.direction.y() * end.direction.x();
  double angle = std::atan2(cross, start.direction.dot(end.direction));
  if (angle < 0) angle += 2 * std::numbers::pi;
  return strength(start.is_held, end.is_held, angle);
}

}  // namespace

double MeshSize::operator()(const Point& p) const {
  double size = h;
  for (const Corner& corner : corners)
    size = std::min(size, std::max(corner.finest, (p - corner.at).norm() / 2));
  return size;
}

MeshSize mesh_size(const Case& scene, const MeshLines& mesh, double h) {
  const double tiny = 1e-8 * extent(mesh.points);
  std::vector<std::vector<Spoke>> spokes(mesh.points.size());
  std::vector<Strength> inner(mesh.points.size(), Strength::regular);  // of lines that end in the point
  for (const MeshLine& line : mesh.lines) {
    const Point &a = mesh.points[line.from], &b = mesh.points[line.to];
    if (!line.outline()) {
      for (const int end : {line.from, line.to})
        inner[end] = std::max(inner[end], line.left != line.right ? Strength::singular : Strength::weak);
      continue;
    }
    const Point along = (b - a).normalized();
    const Held is_held = held(scene.boundaries, a, b, tiny);
    spokes[line.from].push_back({along, line.left >= 0, is_held});
    spokes[line.to].push_back({-along, line.right >= 0, is_held});
  }
  MeshSize size{h, {}};
  for (const MeshLine& line : mesh.lines) {
    const double length = (mesh.points[line.to] - mesh.points[line.from]).norm();
    if (length >= h) continue;
    for (const int end : {line.from, line.to}) size.corners.push_back({mesh.points[end], length});
  }
  for (std::size_t p = 0; p < spokes.size(); ++p) {
    if (spokes[p].empty()) continue;
    const bool on_roller = std::all_of(spokes[p].begin(), spokes[p].end(),
                                       [](const Spoke& s) { return s.is_held == Held::roller; });
    const Strength is = on_roller ? strength(spokes[p]) : std::max(inner[p], strength(spokes[p]));
    if (is == Strength::singular) size.corners.push_back({mesh.points[p], h / 64});
    if (is == Strength::weak) size.corners.push_back({mesh.points[p], h / 8});
  }
  return size;
}

}  // namespace porosph
