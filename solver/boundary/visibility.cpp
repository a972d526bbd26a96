#include "solver/boundary/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

double cross(const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); }

/// Where the line from p to q crosses the edge a b, as a share of its length; infinite where it does not.
double crossing(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  const Vec2 way = q - p, edge = b - a;
  const double determinant = cross(way, edge);
  if (std::abs(determinant) < 1e-12 * way.norm() * edge.norm()) return never;
  const double t = cross(a - p, edge) / determinant, s = cross(a - p, way) / determinant;
  constexpr double slack = 1e-9;
  return t >= 0 && t <= 1 && s >= -slack && s <= 1 + slack ? t : never;
}

/// Even-odd rule over all rings.
bool inside(const std::vector<Polygon>& rings, const Vec2& p) {
  bool in = false;
  for (const Polygon& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) in = !in;
    }
  return in;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + t * along - p).norm();
}

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
                       const Particles& particles, double range, double spacing)
    : range_(range), spacing_(spacing) {
  std::vector<Polygon> all;
  for (const SoilCase& soil : soils) {
    std::vector<Polygon>& rings = rings_.emplace_back();
    rings.push_back(soil.polygon);
    rings.insert(rings.end(), soil.holes.begin(), soil.holes.end());
    all.insert(all.end(), rings.begin(), rings.end());
    for (const Polygon& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  segments_ = along_outlines(walls, all, 1e-3 * spacing);
  walls_ = WallPaths(segments_, range);
  has_slits_ = any_slit_hides(particles);
  ghosts_everywhere_ = walls_.all_in_sight(particles.start);
}

/// Inside or on an outline.
bool Visibility::in_soil(const Vec2& p) const {
  const double on_outline = 1e-6 * spacing_;
  return std::any_of(rings_.begin(), rings_.end(), [&](const auto& rings) { return inside(rings, p); }) ||
         std::any_of(edges_.begin(), edges_.end(),
                     [&](const Edge& e) { return distance(p, e.a, e.b) < on_outline; });
}

Visibility::Exit Visibility::exit(const Vec2& from, const Vec2& to) const {
  const Vec2 way = to - from;
  const double step = 1e-4 * spacing_ / way.norm();
  std::vector<std::pair<double, const Edge*>> crossed;
  for (const Edge& edge : edges_)
    if (const double t = crossing(from, to, edge.a, edge.b); t < never) crossed.emplace_back(t, &edge);
  std::sort(crossed.begin(), crossed.end());
  Exit found;
  double left = never;
  for (const auto& [t, edge] : crossed) {
    if (t + step >= 1) {  // that is where the line ends: on an outline
      if (left < never) found.back = edge;
      break;
    }
    const bool soil_beyond = in_soil(from + (t + step) * way);
    if (left == never && soil_beyond) continue;
    if (left == never) left = t, found.at = from + t * way;
    if (t < left + step)
      found.out.push_back(edge);
    else if (soil_beyond) {
      found.back = edge;
      break;
    }
  }
  return found;
}

/// A line that leaves the soil is free to pass around a corner that is open wide enough.
bool Visibility::hides(const Exit& exit) const {
  if (exit.stays()) return false;
  constexpr double most_cosine = 0.5;  // of the angle that the soil leaves free: 60 degrees
  for (const Edge* out : exit.out) {
    if (exit.back == nullptr) continue;
    const Vec2 ends[2][2] = {{out->a, out->b}, {exit.back->a, exit.back->b}};
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k) {
        const Vec2 &corner = ends[0][i], &other = ends[1][k];
        if ((corner - other).norm() > 1e-6 * spacing_) continue;
        const Vec2 u = (ends[0][1 - i] - corner).normalized(), v = (ends[1][1 - k] - corner).normalized();
        if (u.dot(v) < most_cosine) return false;
      }
  }
  return true;
}

/// A line that a wall hides is the walls' matter.
bool Visibility::through_slit(const Vec2& from, const Vec2& to) const {
  const Exit way_out = exit(from, to);
  return hides(way_out) && std::none_of(segments_.begin(), segments_.end(), [&](const Wall& w) {
           return distance(way_out.at, w.from, w.to) < 1e-3 * spacing_;
         });
}

bool Visibility::past_slits(std::int32_t a, std::int32_t b, const Particles& p) const {
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
  return everywhere() || !hides(exit(point, p.start[b]));
}

/// Of the particles at the start.
bool Visibility::any_slit_hides(const Particles& p) {
  near_edge_.resize(p.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a)
    near_edge_[a] = std::any_of(edges_.begin(), edges_.end(),
                                [&](const Edge& e) { return distance(p.start[a], e.a, e.b) < range_; });
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
