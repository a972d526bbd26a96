#include "solver/geometry/clip.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {
namespace {

Polygon clipped(const Polygon& ring, const HalfPlane& half_plane) {
  Polygon result;
  result.reserve(ring.size() + 2);
  Point a = ring.back();
  double outside_a = half_plane.normal.dot(a) - half_plane.offset;
  for (const Point& b : ring) {
    const double outside_b = half_plane.normal.dot(b) - half_plane.offset;
    if (outside_a * outside_b < 0) result.push_back(a + outside_a / (outside_a - outside_b) * (b - a));
    if (outside_b <= 0) result.push_back(b);
    a = b;
    outside_a = outside_b;
  }
  return result;
}

}  // namespace

void clip(std::vector<Polygon>& rings, const HalfPlane& half_plane) {
  const auto outside = [&](const Point& p) { return half_plane.normal.dot(p) > half_plane.offset; };
  for (Polygon& ring : rings)
    if (std::ranges::any_of(ring, outside)) ring = clipped(ring, half_plane);
  std::erase_if(rings, [](const Polygon& ring) { return ring.size() < 3; });
}

double length_on_line(const std::vector<Polygon>& rings, const HalfPlane& half_plane, double tolerance) {
  const Point along(-half_plane.normal.y(), half_plane.normal.x());
  const auto on_line = [&](const Point& p) {
    return std::abs(half_plane.normal.dot(p) - half_plane.offset) <= tolerance;
  };
  double length = 0;
  for (const Polygon& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      if (on_line(ring[j]) && on_line(ring[i])) length += along.dot(ring[i] - ring[j]);
  return length;
}

Stretch stretch_on_line(const std::vector<Polygon>& rings, const HalfPlane& half_plane, double tolerance) {
  const Point along(-half_plane.normal.y(), half_plane.normal.x());
  Stretch stretch{never, -never};
  for (const Polygon& ring : rings)
    for (const Point& p : ring) {
      if (std::abs(half_plane.normal.dot(p) - half_plane.offset) > tolerance) continue;
      stretch.from = std::min(stretch.from, along.dot(p));
      stretch.to = std::max(stretch.to, along.dot(p));
    }
  return stretch;
}

}  // namespace porosph
