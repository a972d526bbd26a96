#include "solver/boundary/visibility.hpp"

#include <algorithm>
#include <cmath>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

/// The walls, as far as edges of outlines lie along them.
std::vector<Wall> along_outlines(std::span<const Wall> walls, const std::vector<Polygon>& rings,
                                 double tolerance) {
  std::vector<Wall> clipped(walls.begin(), walls.end());
  for (Wall& wall : clipped) {
    const Vec2 along = (wall.to - wall.from).normalized();
    const double length = (wall.to - wall.from).norm();
    double low = never, high = -never;
    for (const Polygon& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if (std::abs(wall.distance(a)) > tolerance || std::abs(wall.distance(b)) > tolerance) continue;
        const double one = (a - wall.from).dot(along), other = (b - wall.from).dot(along);
        const double first = std::max(std::min(one, other), 0.0),
                     last = std::min(std::max(one, other), length);
        if (last - first > tolerance) low = std::min(low, first), high = std::max(high, last);
      }
    if (low > high) continue;
    const Vec2 from = wall.from;
    wall.from = from + low * along, wall.to = from + high * along;
  }
  return clipped;
}

}  // namespace

Visibility::Visibility(const std::vector<SoilCase>& soils, std::span<const Wall> walls,
                       const Particles& particles, double range, double spacing,
                       const std::vector<SheetCase>& sheets)
    : outlines_(soils, spacing), range_(range), spacing_(spacing) {
  for (const SheetCase& sheet : sheets) sheets_.push_back({sheet.from, sheet.to});
  std::vector<Polygon> all;
  for (const SoilCase& soil : soils) {
    all.push_back(soil.polygon);
    all.insert(all.end(), soil.holes.begin(), soil.holes.end());
  }
  segments_ = along_outlines(walls, all, 1e-3 * spacing);
  walls_ = WallPaths(segments_, range);
  has_slits_ = any_slit_hides(particles);
  ghosts_everywhere_ = walls_.all_in_sight(particles.start);
}

Visibility Visibility::without_sheets() const {
  Visibility other = *this;
  other.sheets_.clear();
  return other;
}

bool Visibility::through_sheet(const Vec2& from, const Vec2& to) const {
  return std::ranges::any_of(sheets_, [&](const auto& s) { return segments_cross(from, to, s.a, s.b); });
}

/// A line that a wall hides is the walls' matter.
bool Visibility::through_slit(const Vec2& from, const Vec2& to) const {
  const SoilOutlines::Exit way_out = outlines_.exit(from, to);
  return outlines_.hides(way_out) && std::none_of(segments_.begin(), segments_.end(), [&](const Wall& w) {
           return distance_to_segment(way_out.at, w.from, w.to) < 1e-3 * spacing_;
         });
}

bool Visibility::past_slits(std::int32_t a, std::int32_t b, const Particles& p) const {
  if (through_sheet(p.start[a], p.start[b])) return false;
  if (!has_slits_) return true;
  const double apart = (p.start[a] - p.start[b]).norm();
  if (apart < range_ && !(near_edge_[a] && near_edge_[b])) return true;
  const bool contact = apart > spacing_ && (p.position[a] - p.position[b]).norm() < spacing_;
  return contact || !through_slit(p.start[a], p.start[b]);
}

bool Visibility::sees(std::int32_t a, std::int32_t b, const Particles& p) const {
  return everywhere() ||
         (walls_.clear(p.position[a], p.position[b], walls_.near(p.position[a])) && past_slits(a, b, p));
}

bool Visibility::sees_from(const Vec2& point, std::int32_t b, const Particles& p) const {
  return everywhere() || (!through_sheet(point, p.start[b]) &&
                          (!has_slits_ || !outlines_.hides(outlines_.exit(point, p.start[b]))));
}

/// Of the particles at the start.
bool Visibility::any_slit_hides(const Particles& p) {
  near_edge_.resize(p.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) near_edge_[a] = outlines_.distance(p.start[a]) < range_;
  const NeighbourList near = find_neighbours(p.start, p.size(), range_);
  bool hidden = false;
#pragma omp parallel for schedule(dynamic, 256) reduction(|| : hidden)
  for (std::size_t a = 0; a < p.size(); ++a)
    if (near_edge_[a])
      for (const std::int32_t b : near.of(a))
        hidden = hidden || (near_edge_[b] && through_slit(p.start[a], p.start[b]));
  return hidden;
}

}  // namespace porosph
