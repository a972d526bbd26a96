#include "solver/water/flow/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/case/outline_edges.hpp"
#include "solver/case/shapes.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

constexpr double touching = 1e-3;  // spacings up to which points are one, or on a line

struct Segment {
  Vec2 from, to;  ///< soil on the left
  double length() const { return (to - from).norm(); }
  Vec2 along() const { return (to - from).normalized(); }
};

struct Interval {
  double from, to;
};

/// The part of the segment that the line from a to b covers; empty where they lie apart.
Interval covered(const Segment& s, const Vec2& a, const Vec2& b, double tolerance) {
  const Vec2 along = s.along(), across(-along.y(), along.x());
  if (std::abs(across.dot(a - s.from)) > tolerance || std::abs(across.dot(b - s.from)) > tolerance)
    return {0, 0};
  const auto [low, high] = std::minmax({along.dot(a - s.from), along.dot(b - s.from)});
  return {std::max(low, 0.0), std::min(high, s.length())};
}

/// What is left of [0, length] without the intervals.
std::vector<Interval> without(std::vector<Interval> gone, double length, double tolerance) {
  std::ranges::sort(gone, {}, &Interval::from);
  std::vector<Interval> left;
  double at = 0;
  for (const Interval& i : gone) {
    if (i.to - i.from <= tolerance) continue;
    if (i.from - at > tolerance) left.push_back({at, i.from});
    at = std::max(at, i.to);
  }
  if (length - at > tolerance) left.push_back({at, length});
  return left;
}

std::vector<Segment> outside(const std::vector<SoilCase>& soils, double tolerance) {
  const std::vector<OutlineEdge> edges = outline_edges(soils);
  std::vector<Segment> segments;
  for (const OutlineEdge& edge : edges) {
    Segment s{edge.a, edge.b};
    const Vec2 right(s.along().y(), -s.along().x());
    if (distance(Vec2((s.from + s.to) / 2 + tolerance * right), soils[edge.soil]) == 0)
      std::swap(s.from, s.to);
    std::vector<Interval> inside;
    for (const OutlineEdge& other : edges)
      if (other.soil != edge.soil) inside.push_back(covered(s, other.a, other.b, tolerance));
    for (const Interval& free : without(inside, s.length(), tolerance))
      segments.push_back({s.from + free.from * s.along(), s.from + free.to * s.along()});
  }
  return segments;
}

bool is_continued_by(const Segment& s, const Segment& next, double tolerance) {
  return (s.to - next.from).norm() < tolerance && s.along().dot(next.along()) > 1 - 1e-9;
}

std::vector<Segment> joined(std::vector<Segment> segments, double tolerance) {
  for (std::size_t i = 0; i < segments.size();) {
    const auto next = std::ranges::find_if(segments, [&](const Segment& other) {
      return &other != &segments[i] && is_continued_by(segments[i], other, tolerance);
    });
    if (next == segments.end()) {
      ++i;
      continue;
    }
    segments[i].to = next->to;
    const std::size_t gone = next - segments.begin();
    segments.erase(next);
    if (gone < i) --i;
  }
  return segments;
}

/// Images have images where the outline turns around the soil; at a re-entrant corner there is soil.
Wall mirror(const Segment& s, const std::vector<Segment>& all, double tolerance) {
  const Vec2 along = s.along();
  Wall wall{.kind = BoundaryKind::roller, .from = s.from, .to = s.to};
  wall.normal = Vec2(-along.y(), along.x());
  const auto turns_left = [](const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x() > 1e-9; };
  for (const Segment& other : all) {
    if ((other.to - s.from).norm() < tolerance) wall.continued_at_from |= turns_left(other.along(), along);
    if ((other.from - s.to).norm() < tolerance) wall.continued_at_to |= turns_left(along, other.along());
  }
  return wall;
}

bool is_periodic(const Segment& s, std::span<const BoundaryCase> boundaries, double tolerance) {
  return std::ranges::any_of(boundaries, [&](const BoundaryCase& b) {
    const Interval on = covered(s, b.from, b.to, tolerance);
    return b.kind == BoundaryKind::periodic && on.to - on.from > s.length() / 2;
  });
}

int face_at(const std::vector<HydraulicFaceCase>& faces, const Segment& s, double along, double tolerance) {
  for (std::size_t f = faces.size(); f-- > 0;) {
    if (faces[f].everywhere()) return static_cast<int>(f);
    const Interval on = covered(s, faces[f].from, faces[f].to, tolerance);
    if (along > on.from && along < on.to) return static_cast<int>(f);
  }
  return -1;
}

/// Where conditions may change along a stretch.
std::vector<double> cuts(const std::vector<HydraulicFaceCase>& faces, const Segment& s, double tolerance) {
  std::vector<double> at = {0, s.length()};
  for (const HydraulicFaceCase& face : faces) {
    if (face.everywhere()) continue;
    const Interval on = covered(s, face.from, face.to, tolerance);
    if (on.to - on.from <= tolerance) continue;
    at.push_back(on.from), at.push_back(on.to);
  }
  std::ranges::sort(at);
  std::vector<double> apart;
  for (const double x : at)
    if (apart.empty() || x - apart.back() > tolerance) apart.push_back(x);
  return apart;
}

}  // namespace

int HydraulicOutline::way_back(int stretch) const {
  if (!stretches[stretch].is_periodic()) return stretch;
  const auto other = std::ranges::find_if(stretches, [&](const Wall& w) {
    return w.is_periodic() && w.normal.dot(stretches[stretch].normal) < 0;
  });
  return static_cast<int>(other - stretches.begin());
}

int HydraulicOutline::patch_at(int stretch, double along) const {
  const auto begin = patches.begin() + first[stretch], end = patches.begin() + first[stretch + 1];
  const double length = (end - 1)->to;
  if (along < 0) along = -along;
  if (along > length) along = std::max(0.0, 2 * length - along);
  const auto found = std::find_if(begin, end - 1, [&](const HydraulicPatch& p) { return along <= p.to; });
  return static_cast<int>(found - patches.begin());
}

HydraulicOutline hydraulic_outline(const std::vector<SoilCase>& soils,
                                   const std::vector<HydraulicFaceCase>& faces, double spacing,
                                   std::span<const BoundaryCase> boundaries) {
  const double tolerance = touching * spacing;
  std::vector<Segment> segments = joined(outside(soils, tolerance), tolerance);
  const auto goes_on = [&](const Segment& s) { return is_periodic(s, boundaries, tolerance); };
  // clang 14 does not compile the stable_partition of std::ranges.
  std::stable_partition(segments.begin(), segments.end(), [&](const Segment& s) { return !goes_on(s); });
  HydraulicOutline outline;
  outline.first = {0};
  for (const Segment& s : segments) {
    const int stretch = static_cast<int>(outline.stretches.size());
    outline.stretches.push_back(mirror(s, segments, tolerance));
    if (goes_on(s)) outline.stretches.back().kind = BoundaryKind::periodic;
    const std::vector<double> at = cuts(faces, s, tolerance);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const double count = std::ceil(2 * (at[i + 1] - at[i]) / spacing), step = (at[i + 1] - at[i]) / count;
      const int face = face_at(faces, s, (at[i] + at[i + 1]) / 2, tolerance);
      for (int k = 0; k < count; ++k)
        outline.patches.push_back({stretch, at[i] + k * step, at[i] + (k + 1) * step, face});
    }
    outline.first.push_back(static_cast<std::int32_t>(outline.patches.size()));
  }
  join_sides(outline.stretches);
  return outline;
}

std::string unnamed_stretch(const HydraulicOutline& outline) {
  const auto unnamed = [](const HydraulicPatch& p) { return p.face < 0; };
  const auto begin = std::ranges::find_if(outline.patches, unnamed);
  if (begin == outline.patches.end()) return "";
  auto last = begin;
  while (last + 1 != outline.patches.end() && unnamed(*(last + 1)) && (last + 1)->stretch == begin->stretch)
    ++last;
  const Vec2 from = outline.at(begin->stretch, begin->from), to = outline.at(begin->stretch, last->to);
  return fmt::format("{} to {}", place_text(from), place_text(to));
}

bool touches(const HydraulicFaceCase& face, const std::vector<SoilCase>& soils, double spacing) {
  if (face.everywhere()) return true;
  const double tolerance = touching * spacing;
  return std::ranges::any_of(outside(soils, tolerance), [&](const Segment& s) {
    const Interval on = covered(s, face.from, face.to, tolerance);
    return on.to - on.from > tolerance;
  });
}

}  // namespace porosph
