#include "solver/geometry/bands.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {
namespace {

struct Edge {
  Point a, b;
  std::size_t soil = 0;
};

std::vector<Edge> edges_of(const std::vector<Region>& regions) {
  std::vector<Edge> edges;
  for (std::size_t soil = 0; soil < regions.size(); ++soil)
    for (const Polygon& ring : regions[soil].rings())
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
        edges.push_back({ring[j], ring[i], soil});
  return edges;
}

/// Whether the segment from c to d covers part of the edge.
bool covers(const Point& c, const Point& d, const Edge& edge, double tolerance) {
  const Point line = edge.b - edge.a;
  const double length = line.norm();
  const Point along = line / length, across(-along.y(), along.x());
  if (std::abs(across.dot(c - edge.a)) > tolerance || std::abs(across.dot(d - edge.a)) > tolerance)
    return false;
  const auto [from, to] = std::minmax({along.dot(c - edge.a), along.dot(d - edge.a)});
  return std::min(to, length) - std::max(from, 0.0) > tolerance;
}

bool is_free(const Edge& edge, const std::vector<Edge>& edges, const Case& scene, double tolerance) {
  return std::ranges::none_of(
             scene.boundaries,
             [&](const BoundaryCase& wall) { return covers(wall.from, wall.to, edge, tolerance); }) &&
         std::ranges::none_of(edges, [&](const Edge& other) {
           return other.soil != edge.soil && covers(other.a, other.b, edge, tolerance);
         });
}

/// A coordinate that bands keep to.
struct Line {
  double at = 0;
  bool free = false;  ///< in the middle of a band, not at an end
};

bool is_near(const std::vector<Line>& lines, double at, double range) {
  return std::ranges::any_of(lines, [&](const Line& line) { return std::abs(line.at - at) <= range; });
}

/// A line that is free only where all edges on it are.
void add(Line line, double tolerance, std::vector<Line>& lines) {
  for (Line& known : lines)
    if (std::abs(known.at - line.at) <= tolerance) {
      known.free = known.free && line.free;
      return;
    }
  lines.push_back(line);
}

std::vector<Line> lines_along(int axis, const Case& scene, const std::vector<Edge>& edges) {
  const double spacing = scene.particles.spacing, tolerance = 1e-6 * spacing;
  std::vector<Line> lines;
  std::vector<double> ends;  // of free surfaces along the other axis
  double low = never, high = -never;
  for (const Edge& e : edges) {
    low = std::min(low, e.a[axis]), high = std::max(high, e.a[axis]);
    const bool along = std::abs(e.a[axis] - e.b[axis]) <= tolerance,
               across = std::abs(e.a[1 - axis] - e.b[1 - axis]) <= tolerance;
    if (along) add({e.a[axis], is_free(e, edges, scene, tolerance)}, tolerance, lines);
    if (across && is_free(e, edges, scene, tolerance)) ends.insert(ends.end(), {e.a[axis], e.b[axis]});
  }
  for (double at : {low, high})  // the tip of a wedge
    if (!is_near(lines, at, spacing / 2)) lines.push_back({at, false});
  for (double at : ends)
    if (!is_near(lines, at, 5 * spacing)) lines.push_back({at, true});
  std::ranges::sort(lines, {}, &Line::at);
  return lines;
}

/// Half bands that fit between two lines, as near to half the spacing as they can.
int half_bands(const Line& from, const Line& to, double spacing) {
  const double bands = (to.at - from.at) / spacing;
  if (from.free != to.free) return 2 * std::max(0, static_cast<int>(std::lround(bands - 0.5))) + 1;
  return 2 * std::max(1, static_cast<int>(std::lround(bands)));
}

}  // namespace

std::vector<Band> bands_along(int axis, const Case& scene, const std::vector<Region>& regions) {
  const std::vector<Line> lines = lines_along(axis, scene, edges_of(regions));
  std::vector<Band> bands;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const Line &from = lines[i], &to = lines[i + 1];
    const int halves = half_bands(from, to, scene.particles.spacing);
    const double half = (to.at - from.at) / halves;
    if (from.free && i == 0) bands.push_back({from.at, from.at - half, from.at});
    if (from.free) bands.back().high = from.at + half;
    for (int k = from.free ? 2 : 1; k <= (to.free ? halves : halves - 1); k += 2)
      bands.push_back({from.at + k * half, from.at + (k - 1) * half, from.at + (k + 1) * half});
  }
  return bands;
}

}  // namespace porosph
