#include "solver/reference/fem/mesh_lines.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <stdexcept>

#include "solver/case/shapes.hpp"
#include "solver/reference/fem/constraints.hpp"
#include "solver/reference/fem/mesh.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

struct Segment {
  Point a, b;
  bool water;  ///< a line of the water, which is kept inside a soil as well
};

void add_polygon(const Polygon& polygon, std::vector<Segment>& segments) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()], false});
}

/// Water levels and stretch ends, as far as they cross the box around the soil.
void add_water(const WaterCase& water, const Eigen::AlignedBox2d& box, std::vector<Segment>& segments) {
  for (const WaterStretch& stretch : water.stretches) {
    const double left = std::max(stretch.x_from, box.min().x()),
                 right = std::min(stretch.x_to, box.max().x());
    const double top = std::min(stretch.level, box.max().y());
    if (left >= right || top <= box.min().y()) continue;
    if (stretch.level < box.max().y()) segments.push_back({{left, top}, {right, top}, true});
    for (const double x : {stretch.x_from, stretch.x_to})
      if (x > box.min().x() && x < box.max().x()) segments.push_back({{x, box.min().y()}, {x, top}, true});
  }
}

/// Index of the point, added if it is new.
int index_of(const Point& p, double tiny, std::vector<Point>& points) {
  const auto found =
      std::find_if(points.begin(), points.end(), [&](const Point& q) { return (p - q).norm() <= tiny; });
  if (found != points.end()) return static_cast<int>(found - points.begin());
  points.push_back(p);
  return static_cast<int>(points.size()) - 1;
}

std::vector<Segment> segments_of(const Case& scene, const Eigen::AlignedBox2d& box) {
  std::vector<Segment> segments;
  for (const SoilCase& soil : scene.soils) {
    add_polygon(soil.polygon, segments);
    for (const Polygon& hole : soil.holes) add_polygon(hole, segments);
  }
  add_water(scene.water, box, segments);
  return segments;
}

/// All points where the segments end or meet, and where boundaries, faces of the water, loads and footings
/// end.
std::vector<Point> meeting_points(const std::vector<Segment>& segments, const Case& scene) {
  std::vector<Point> points;
  for (const Segment& s : segments) {
    points.push_back(s.a);
    points.push_back(s.b);
  }
  for (const BoundaryCase& boundary : scene.boundaries) {
    points.push_back(boundary.from);
    points.push_back(boundary.to);
  }
  for (const HydraulicFaceCase& face : scene.water.faces) {
    if (face.everywhere()) continue;
    points.push_back(face.from);
    points.push_back(face.to);
  }
  for (const LoadCase& load : scene.loads) points.insert(points.end(), {load.from, load.to});
  for (const FootingCase& footing : scene.footings) points.insert(points.end(), {footing.from, footing.to});
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const Point& p : crossings(segments[i].a, segments[i].b, segments[j].a, segments[j].b))
        points.push_back(p);
  return points;
}

}  // namespace

int soil_at(const Case& scene, const Point& p) {
  int found = -1;
  for (int s = 0; s < static_cast<int>(scene.soils.size()); ++s) {
    if (distance(p, scene.soils[s]) > 0) continue;
    if (found >= 0)
      throw std::runtime_error(fmt::format("mesh: soils '{}' and '{}' overlap around {}",
                                           scene.soils[found].name, scene.soils[s].name, place_text(p)));
    found = s;
  }
  return found;
}

MeshLines mesh_lines(const Case& scene) {
  Eigen::AlignedBox2d box;
  for (const SoilCase& soil : scene.soils)
    for (const Point& p : soil.polygon) box.extend(p);
  if (box.isEmpty()) throw std::runtime_error("mesh: the case has no soil");
  const double tiny = 1e-8 * box.diagonal().norm(), aside = 1e-6 * box.diagonal().norm();
  const std::vector<Segment> segments = segments_of(scene, box);
  const std::vector<Point> stops = meeting_points(segments, scene);

  MeshLines mesh;
  std::set<std::pair<int, int>> known;
  for (const Segment& segment : segments) {
    std::vector<Point> along;
    for (const Point& p : stops)
      if (on_segment(p, segment.a, segment.b, tiny)) along.push_back(p);
    const Point direction = (segment.b - segment.a).normalized(), normal(-direction.y(), direction.x());
    std::sort(along.begin(), along.end(),
              [&](const Point& p, const Point& q) { return p.dot(direction) < q.dot(direction); });
    for (std::size_t i = 0; i + 1 < along.size(); ++i) {
      if ((along[i + 1] - along[i]).norm() <= tiny) continue;
      const Point middle = (along[i] + along[i + 1]) / 2;
      const int left = soil_at(scene, middle + aside * normal),
                right = soil_at(scene, middle - aside * normal);
      if (left == right && (left < 0 || !segment.water)) continue;
      const int from = index_of(along[i], tiny, mesh.points), to = index_of(along[i + 1], tiny, mesh.points);
      if (from != to && known.insert(std::minmax(from, to)).second)
        mesh.lines.push_back({from, to, left, right});
    }
  }
  return mesh;
}

}  // namespace porosph
