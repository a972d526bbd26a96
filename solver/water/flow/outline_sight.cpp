#include "solver/water/flow/outline_sight.hpp"

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

double distance_to_line(const Vec2& p, const Vec2& from, const Vec2& to) {
  return std::abs(cross((to - from).normalized(), p - from));
}

/// Both ends of the edge lie on the line of the wall.
bool on_line(const Vec2& a, const Vec2& b, const Wall& wall, double tolerance) {
  return distance_to_line(a, wall.from, wall.to) < tolerance &&
         distance_to_line(b, wall.from, wall.to) < tolerance;
}

/// Where a ghost was at the start.
Vec2 start_of(std::size_t ghost, const Ghosts& ghosts, const Particles& p) {
  const Vec2 parent = ghosts.stems_from_ghost(ghost)
                          ? start_of(ghosts.parent(ghost) - ghosts.particles(), ghosts, p)
                          : p.start[ghosts.parent(ghost)];
  return ghosts.wall(ghost).mirrored(parent);
}

}  // namespace

OutlineSight::OutlineSight(const std::vector<SoilCase>& soils, std::span<const Wall> walls,
                           const Particles& particles, double range, double spacing)
    : range_(range), spacing_(spacing) {
  for (const SoilCase& soil : soils) {
    std::vector<Polygon>& rings = rings_.emplace_back();
    rings.push_back(soil.polygon);
    rings.insert(rings.end(), soil.holes.begin(), soil.holes.end());
    for (const Polygon& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  find_hidden(walls, particles);
}

/// Inside or on an outline.
bool OutlineSight::in_soil(const Vec2& p) const {
  const double on_outline = 1e-6 * spacing_;
  return std::any_of(rings_.begin(), rings_.end(), [&](const auto& rings) { return inside(rings, p); }) ||
         std::any_of(edges_.begin(), edges_.end(),
                     [&](const Edge& e) { return distance(p, e.a, e.b) < on_outline; });
}

OutlineSight::Exit OutlineSight::exit(const Vec2& from, const Vec2& to) const {
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
    if (left == never) left = t;
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
bool OutlineSight::hides(const Exit& exit) const {
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

bool OutlineSight::sees(std::int32_t a, std::int32_t b, const Particles& p) const {
  if (everywhere_) return true;
  return !hides(exit(p.start[a], p.start[b]));
}

/// Behind a corner of more than a right angle, ghosts of ghosts lie where a single wall has ghosts already.
bool OutlineSight::is_image_in_one_wall(const Vec2& start, std::size_t ghost, const Ghosts& ghosts) const {
  const auto covers = [&](const Wall& wall) {
    const Vec2 source = wall.mirrored(start);
    return wall.faces(source, range_) && in_soil(source);
  };
  const std::size_t parent = ghosts.parent(ghost) - ghosts.particles();
  return covers(ghosts.wall(ghost)) || covers(ghosts.wall(parent));
}

bool OutlineSight::sees_ghost(std::int32_t a, std::size_t ghost, const Ghosts& ghosts,
                              const Particles& p) const {
  if (everywhere_) return true;
  const Vec2 start = start_of(ghost, ghosts, p);
  if (ghosts.stems_from_ghost(ghost) && is_image_in_one_wall(start, ghost, ghosts)) return false;
  const Exit way_out = exit(p.start[a], start);
  for (std::size_t g = ghost;; g = ghosts.parent(g) - ghosts.particles()) {
    for (const Edge* edge : way_out.out)
      if (on_line(edge->a, edge->b, ghosts.wall(g), 1e-3 * spacing_)) return true;
    if (!ghosts.stems_from_ghost(g)) return false;
  }
}

/// Of the particles at the start.
void OutlineSight::find_hidden(std::span<const Wall> walls, const Particles& p) {
  const auto n = static_cast<std::int32_t>(p.size());
  std::vector<std::uint8_t> near(p.size());
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a)
    near[a] = std::any_of(edges_.begin(), edges_.end(),
                          [&](const Edge& e) { return distance(p.start[a], e.a, e.b) < range_; });
  std::vector<Vec2> points = p.start;
  const Ghosts ghosts(walls, 0, walls.size(), range_, points);
  const NeighbourList all = find_neighbours(points, p.size(), range_);
  everywhere_ = false;  // so that they are looked at
  bool soil = false, ghost = false;
#pragma omp parallel for schedule(dynamic, 256) reduction(|| : soil, ghost)
  for (std::int32_t a = 0; a < n; ++a) {
    if (!near[a]) continue;
    for (const std::int32_t b : all.of(a)) {
      if (b >= n)
        ghost = ghost || !sees_ghost(a, b - n, ghosts, p);
      else
        soil = soil || (near[b] && !sees(a, b, p));
    }
  }
  everywhere_ = !soil && !ghost;
}

}  // namespace porosph
