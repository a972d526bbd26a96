#include "solver/boundary/soil_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

}  // namespace

bool segments_cross(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  return crossing(p, q, a, b) < never;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + t * along - p).norm();
}

SoilOutlines::SoilOutlines(const std::vector<SoilCase>& soils, double spacing) : spacing_(spacing) {
  for (const SoilCase& soil : soils) {
    std::vector<Polygon>& rings = rings_.emplace_back();
    rings.push_back(soil.polygon);
    rings.insert(rings.end(), soil.holes.begin(), soil.holes.end());
    for (const Polygon& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
}

double SoilOutlines::distance(const Vec2& p) const {
  double least = never;
  for (const Edge& e : edges_) least = std::min(least, distance_to_segment(p, e.a, e.b));
  return least;
}

bool SoilOutlines::in_soil(const Vec2& p) const {
  const double on_outline = 1e-6 * spacing_;
  return std::any_of(rings_.begin(), rings_.end(), [&](const auto& rings) { return inside(rings, p); }) ||
         std::any_of(edges_.begin(), edges_.end(),
                     [&](const Edge& e) { return distance_to_segment(p, e.a, e.b) < on_outline; });
}

SoilOutlines::Exit SoilOutlines::exit(const Vec2& from, const Vec2& to) const {
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

bool SoilOutlines::hides(const Exit& exit) const {
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

}  // namespace porosph
