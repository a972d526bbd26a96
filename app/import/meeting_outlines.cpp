#include "app/import/meeting_outlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/import/drawing.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::drawn {
namespace {

double twice_area(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    sum += p[j].x() * p[i].y() - p[j].y() * p[i].x();
  return sum;
}

/// The corners of all outlines, each once.
class Corners {
 public:
  explicit Corners(double snap) : snap_(snap) {}

  /// The first corner that is near, or else this one.
  Point place(const Point& p) {
    const auto near =
        std::ranges::find_if(all_, [&](const Point& corner) { return (corner - p).norm() <= snap_; });
    if (near == all_.end()) return all_.emplace_back(p);
    farthest_ = std::max(farthest_, (*near - p).norm());
    return *near;
  }
  const std::vector<Point>& all() const { return all_; }
  double farthest() const { return farthest_; }  ///< that a corner was moved [m]

 private:
  std::vector<Point> all_;
  double snap_, farthest_ = 0;
};

Polygon without_repeats(const Polygon& ring) {
  Polygon kept;
  for (const Point& p : ring)
    if (kept.empty() || kept.back() != p) kept.push_back(p);
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  return kept;
}

/// The line with those of the corners that lie on its edges.
Polygon with_corners(const Polygon& line, const std::vector<Point>& corners, double snap) {
  Polygon all;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point &a = line[i], &b = line[i + 1];
    const double length = (b - a).norm();
    const Point along = (b - a) / length;
    std::vector<std::pair<double, Point>> on_edge;
    for (const Point& c : corners) {
      const double at = along.dot(c - a), off = std::abs(along.x() * (c - a).y() - along.y() * (c - a).x());
      if (off <= snap && at > snap && at < length - snap) on_edge.emplace_back(at, c);
    }
    std::ranges::sort(on_edge, {}, [](const auto& pair) { return pair.first; });
    all.push_back(a);
    for (const auto& [at, c] : on_edge) all.push_back(c);
  }
  all.push_back(line.back());
  return all;
}

bool is_near(const Point& p, const Polygon& outline, double snap) {
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Point &a = outline[i], &b = outline[j];
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    if ((p - a - t * (b - a)).norm() <= snap) return true;
  }
  return false;
}

/// Whether every corner of `inner` is inside `outer`, none on its outline.
bool encloses(const Polygon& outer, const Polygon& inner, double snap) {
  return std::ranges::all_of(inner,
                             [&](const Point& p) { return !is_near(p, outer, snap) && is_inside(p, outer); });
}

/// Whether every corner and the middle of every edge of `inner` is inside `outer` or on its outline.
bool covers(const Polygon& outer, const Polygon& inner, double snap) {
  for (std::size_t i = 0, j = inner.size() - 1; i < inner.size(); j = i++) {
    const Point middle = (inner[i] + inner[j]) / 2;
    for (const Point& p : {inner[i], middle})
      if (!is_near(p, outer, snap) && !is_inside(p, outer)) return false;
  }
  return true;
}

bool same_corners(const Polygon& a, const Polygon& b) {
  return a.size() == b.size() && std::ranges::is_permutation(a, b);
}

/// Holes of one region must not touch: then it is a frame around soils rather than a soil itself.
void require_apart(const Polygon& hole, const std::string& name, const Region& around) {
  for (std::size_t k = 1; k < around.rings.size(); ++k)
    for (const Point& p : hole)
      if (std::ranges::find(around.rings[k], p) != around.rings[k].end())
        throw DrawingError(
            fmt::format("'{}' surrounds '{}' and another soil, which touch each other at {} m: "
                        "leave it out (--skip "
                        "LAYER) or draw it without them",
                        around.name, name, place_text(p)));
}

/// The smallest other region around this one.
std::optional<std::size_t> parent_of(const std::vector<Region>& regions, std::size_t i, double snap) {
  std::optional<std::size_t> parent;
  for (std::size_t j = 0; j < regions.size(); ++j) {
    if (j == i || !encloses(regions[j].rings[0], regions[i].rings[0], snap)) continue;
    if (!parent || twice_area(regions[j].rings[0]) < twice_area(regions[*parent].rings[0])) parent = j;
  }
  return parent;
}

}  // namespace

bool is_inside(const Point& p, const Polygon& outline) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Point &a = outline[i], &b = outline[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

double make_lines_meet(std::vector<Polygon>& lines, double snap) {
  Corners corners(snap);
  for (Polygon& line : lines) {
    for (Point& p : line) p = corners.place(p);
    line.erase(std::unique(line.begin(), line.end()), line.end());
  }
  std::erase_if(lines, [](const Polygon& line) { return line.size() < 2; });
  for (Polygon& line : lines) line = with_corners(line, corners.all(), snap);
  return corners.farthest();
}

std::vector<std::string> make_outlines_meet(std::vector<Region>& regions, double snap) {
  std::vector<std::string> notes;
  Corners corners(snap);
  for (Region& region : regions)
    for (Polygon& ring : region.rings) {
      for (Point& p : ring) p = corners.place(p);
      ring = without_repeats(ring);
    }
  const auto is_flat = [&](const Polygon& ring) {
    return ring.size() < 3 || std::abs(twice_area(ring)) <= snap * snap;
  };
  std::erase_if(regions, [&](const Region& region) {
    if (is_flat(region.rings[0])) notes.push_back(fmt::format("'{}' has no area: left out", region.name));
    return is_flat(region.rings[0]);
  });
  for (Region& region : regions) std::erase_if(region.rings, is_flat);
  for (Region& region : regions)
    for (std::size_t k = 0; k < region.rings.size(); ++k) {
      Polygon& ring = region.rings[k];
      ring.push_back(ring.front());
      ring = with_corners(ring, corners.all(), snap);
      ring.pop_back();
      if ((twice_area(ring) > 0) != (k == 0)) std::ranges::reverse(ring);
    }
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t j = regions.size() - 1; j > i; --j)
      if (same_corners(regions[i].rings[0], regions[j].rings[0])) {
        notes.push_back(fmt::format("'{}' is drawn like '{}': left out", regions[j].name, regions[i].name));
        regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(j));
      }
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (const auto parent = parent_of(regions, i, snap)) {
      std::vector<Polygon>& rings = regions[*parent].rings;
      Polygon hole = regions[i].rings[0];
      const bool is_drawn = std::any_of(rings.begin() + 1, rings.end(),
                                        [&](const Polygon& ring) { return covers(ring, hole, snap); });
      if (is_drawn) continue;
      require_apart(hole, regions[i].name, regions[*parent]);
      std::ranges::reverse(hole);
      rings.push_back(std::move(hole));
      notes.push_back(fmt::format("'{}' lies inside '{}', which has a hole there", regions[i].name,
                                  regions[*parent].name));
    }
  if (corners.farthest() > 1e-9)
    notes.push_back(fmt::format("corners that were up to {:.2g} m apart were made one", corners.farthest()));
  return notes;
}

}  // namespace porosph::drawn
