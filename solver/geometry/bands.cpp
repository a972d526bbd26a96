#include "solver/geometry/bands.hpp"

#include <algorithm>
#include <cmath>

#include "solver/case/outline_edges.hpp"

namespace porosph {
namespace {

std::vector<OutlineEdge> edges_of(const std::vector<Region>& regions) {
  std::vector<std::vector<Polygon>> rings;
  for (const Region& region : regions) rings.push_back(region.rings());
  return outline_edges(rings);
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

std::vector<Line> lines_along(int axis, const Case& scene, const std::vector<OutlineEdge>& edges,
                              FreeSurfaces free_surfaces) {
  const auto is_middle = [&](const OutlineEdge& e, double tolerance) {
    return free_surfaces == FreeSurfaces::in_the_middle && is_free(e, edges, scene.boundaries, tolerance);
  };
  const double spacing = scene.particles.spacing, tolerance = 1e-6 * spacing;
  std::vector<Line> lines;
  std::vector<double> ends;  // of free surfaces along the other axis
  double low = never, high = -never;
  for (const OutlineEdge& e : edges) {
    low = std::min(low, e.a[axis]), high = std::max(high, e.a[axis]);
    const bool along = std::abs(e.a[axis] - e.b[axis]) <= tolerance,
               across = std::abs(e.a[1 - axis] - e.b[1 - axis]) <= tolerance;
    if (along) add({e.a[axis], is_middle(e, tolerance)}, tolerance, lines);
    if (across && is_middle(e, tolerance)) ends.insert(ends.end(), {e.a[axis], e.b[axis]});
  }
  for (const SheetCase& sheet : scene.sheets) {
    const bool along = std::abs(sheet.from[axis] - sheet.to[axis]) <= tolerance;
    if (along && sheet.from[axis] > low - tolerance && sheet.from[axis] < high + tolerance)
      add({sheet.from[axis], false}, tolerance, lines);
    for (const double end : {sheet.from[axis], sheet.to[axis]})
      if (!along && end > low && end < high && !is_near(lines, end, spacing / 2))
        lines.push_back({end, false});
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

std::vector<Band> bands_along(int axis, const Case& scene, const std::vector<Region>& regions,
                              FreeSurfaces free_surfaces) {
  const std::vector<Line> lines = lines_along(axis, scene, edges_of(regions), free_surfaces);
  std::vector<Band> bands;
  double half_before = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const Line &from = lines[i], &to = lines[i + 1];
    const int halves = half_bands(from, to, scene.particles.spacing);
    const double half = (to.at - from.at) / halves;
    const auto add = [&](int k) {
      bands.push_back({from.at + k * half, from.at + (k - 1) * half, from.at + (k + 1) * half, half + half});
    };
    if (from.free && i == 0)
      add(0);
    else if (from.free)
      bands.back().high = from.at + half, bands.back().width = half_before + half;
    for (int k = from.free ? 2 : 1; k <= (to.free ? halves : halves - 1); k += 2) add(k);
    half_before = half;
  }
  return bands;
}

}  // namespace porosph
