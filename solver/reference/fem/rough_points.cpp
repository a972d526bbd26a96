#include "solver/reference/fem/rough_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "solver/boundary/support.hpp"
#include "solver/reference/fem/constraints.hpp"
#include "solver/reference/fem/mesh.hpp"

namespace porosph {
namespace {

enum class Strength { regular, weak, singular };
enum class Held { no, roller, fixed };

Held held(const std::vector<BoundaryCase>& boundaries, const Point& a, const Point& b, double tiny) {
  Held strongest = Held::no;
  for (const BoundaryCase& boundary : boundaries)
    if (on_segment(a, boundary.from, boundary.to, tiny) && on_segment(b, boundary.from, boundary.to, tiny))
      strongest = std::max(strongest, support_of(boundary.kind).carries_shear() ? Held::fixed : Held::roller);
  return strongest;
}

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

/// Within the soil, where two lines of the outline meet.
double angle_between(const std::vector<Spoke>& spokes) {
  const Spoke& start = spokes[spokes[0].soil_on_left ? 0 : 1];
  const Spoke& end = spokes[spokes[0].soil_on_left ? 1 : 0];
  const double cross = start.direction.x() * end.direction.y() - start.direction.y() * end.direction.x();
  double angle = std::atan2(cross, start.direction.dot(end.direction));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

Strength strength(const std::vector<Spoke>& spokes) {
  if (spokes.size() != 2) return Strength::singular;  // parts of the outline touch in this point
  return strength(spokes[0].is_held, spokes[1].is_held, angle_between(spokes));
}

/// What the outline and the lines that end on it make of a point.
struct Meeting {
  std::vector<Spoke> spokes;           ///< of the outline
  Strength inner = Strength::regular;  ///< of other lines that end here
  std::vector<Point> interfaces;       ///< directions of the lines between two soils
  double shortest = never;             ///< of all these lines [m]
};

std::vector<Meeting> meetings(const Case& scene, const MeshLines& mesh) {
  const double tiny = 1e-8 * extent(mesh.points);
  std::vector<Meeting> all(mesh.points.size());
  for (const MeshLine& line : mesh.lines) {
    const Point &a = mesh.points[line.from], &b = mesh.points[line.to];
    const Point along = (b - a).normalized();
    const bool interface = !line.outline() && line.left != line.right;
    for (const int end : {line.from, line.to}) {
      Meeting& at = all[end];
      at.shortest = std::min(at.shortest, (b - a).norm());
      if (!line.outline()) at.inner = std::max(at.inner, interface ? Strength::singular : Strength::weak);
      if (interface) at.interfaces.push_back(end == line.from ? along : Point(-along));
    }
    if (!line.outline()) continue;
    const Held is_held = held(scene.boundaries, a, b, tiny);
    all[line.from].spokes.push_back({along, line.left >= 0, is_held});
    all[line.to].spokes.push_back({-along, line.right >= 0, is_held});
  }
  return all;
}

bool is_on_rollers(const Meeting& at) {
  return std::all_of(at.spokes.begin(), at.spokes.end(),
                     [](const Spoke& s) { return s.is_held == Held::roller; });
}

/// Of a point on the outline.
Strength strength(const Meeting& at) {
  return is_on_rollers(at) ? strength(at.spokes) : std::max(at.inner, strength(at.spokes));
}

/// Whether lines between two soils turn or branch in a point inside.
bool is_interface_corner(const Meeting& at) {
  if (!at.spokes.empty() || at.interfaces.empty()) return false;
  const double cosine_of_slack = std::cos(std::numbers::pi / 18);
  return at.interfaces.size() != 2 || at.interfaces[0].dot(at.interfaces[1]) > -cosine_of_slack;
}

}  // namespace

std::vector<RoughPoint> rough_points(const Case& scene, const MeshLines& mesh) {
  std::vector<RoughPoint> points;
  const std::vector<Meeting> all = meetings(scene, mesh);
  for (std::size_t p = 0; p < all.size(); ++p) {
    const auto add = [&](RoughPoint::Kind kind) {
      points.push_back({.at = mesh.points[p],
                        .kind = kind,
                        .shortest = all[p].shortest,
                        .angle = all[p].spokes.size() == 2 ? angle_between(all[p].spokes) : 0,
                        .on_rollers = is_on_rollers(all[p])});
    };
    if (is_interface_corner(all[p])) add(RoughPoint::interface_corner);
    if (all[p].spokes.empty()) continue;
    const Strength is = strength(all[p]);
    if (is == Strength::singular) add(RoughPoint::singular);
    if (is == Strength::weak) add(RoughPoint::weak);
  }
  return points;
}

}  // namespace porosph
