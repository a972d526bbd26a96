#include "solver/run/surface_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "solver/boundary/traction.hpp"
#include "solver/case/outline_edges.hpp"
#include "solver/case/shapes.hpp"
#include "solver/soil/linear_elastic.hpp"
#include "solver/sph/dynamics.hpp"
#include "solver/water/still_water.hpp"

namespace porosph {
namespace {

constexpr double some_area = 1e-6;  // of the spacing: less is rounding

/// Accelerations under a uniform stress without weight, water and motion.
std::vector<Vec2> accelerations_under(const Stress& stress, const FormulationCase& formulation, Model model) {
  Particles& p = model.particles;
  model.gravity = Vec2::Zero();
  model.water = StandingWater();
  model.pore_water = std::make_shared<StillWater>();
  model.loads.clear();
  for (Soil& soil : model.soils) soil = Soil(LinearElastic{soil.elastic()});
  std::ranges::fill(p.velocity, Vec2::Zero());
  std::ranges::fill(p.pore_pressure, 0.0);
  std::ranges::fill(p.interface_stress, 0.0);
  std::ranges::fill(p.stress, stress);
  const auto dynamics = make_dynamics(formulation, model);
  std::vector<Vec2> a(p.size(), Vec2::Zero());
  dynamics->prepare();
  dynamics->accelerations(a);
  return a;
}

/// Straight parts of the outlines without a wall and without other soil behind.
std::vector<OutlineEdge> free_edges(const Case& scene) {
  std::vector<OutlineEdge> edges = outline_edges(scene.soils), free;
  for (const OutlineEdge& edge : edges)
    if (is_free(edge, edges, scene.boundaries, 1e-6 * scene.particles.spacing)) free.push_back(edge);
  return free;
}

Vec2 unit_normal(const Vec2& from, const Vec2& to) {
  const Vec2 way = to - from;
  return Vec2(way.y(), -way.x()).normalized();
}

/// The free edges around a face.
struct Edges {
  std::vector<OutlineEdge> in_line;  ///< on it or opposite
  std::vector<OutlineEdge> bends;    ///< on which the outline turns by less than 45 degrees from it
  std::vector<OutlineEdge> corners;  ///< all others
};

Edges edges_around(const Case& scene, const std::vector<OutlineEdge>& free_edges, const Vec2& normal) {
  const double blunt = std::sqrt(0.5) + 1e-9;
  Edges around;
  for (const OutlineEdge& edge : free_edges) {
    const double turn = outward_normal(scene, edge.a, edge.b).dot(normal);
    auto& kind = std::abs(turn) > 1 - 1e-9 ? around.in_line : turn > blunt ? around.bends : around.corners;
    kind.push_back(edge);
  }
  return around;
}

struct Nearest {
  double distance;
  const OutlineEdge* edge = nullptr;  ///< or none within reach
};

Nearest nearest_of(const std::vector<OutlineEdge>& edges, const Vec2& place, double reach) {
  Nearest nearest{.distance = reach};
  for (const OutlineEdge& edge : edges)
    if (const double d = distance(place, place, edge.a, edge.b); d < nearest.distance)
      nearest = {.distance = d, .edge = &edge};
  return nearest;
}

/// The part of a particle's surface vector that belongs to a face with this normal: beside a corner the rest
/// is that of the other face in reach.
double area_on(const Vec2& surface_vector, const Vec2& normal, const OutlineEdge* beside) {
  if (!beside) return surface_vector.dot(normal);
  const Vec2 other = unit_normal(beside->a, beside->b);
  Mat2 faces;
  faces << normal.x(), other.x(), normal.y(), other.y();
  return (faces.inverse() * surface_vector).x();
}

/// The share of a particle's width along the stretch that lies on it.
double share_on(double along, double length, double width) {
  return std::clamp(std::min(along + width / 2, length) - std::max(along - width / 2, 0.0), 0.0, width) /
         width;
}

/// A straight part of the surface, from where a stretch on it begins [m].
struct Face {
  double low, high;
};

/// The face that a stretch lies on.
Face face_of(const Point& start, const Point& end, const std::vector<OutlineEdge>& free_edges,
             double tolerance) {
  const Vec2 along = (end - start).normalized(), normal = unit_normal(start, end);
  const auto off_line = [&](const Point& p) { return std::abs((p - start).dot(normal)) > tolerance; };
  Face face{0, (end - start).norm()};
  for (std::size_t joined = 0; joined < free_edges.size(); ++joined)  // in any order
    for (const OutlineEdge& edge : free_edges) {
      if (off_line(edge.a) || off_line(edge.b)) continue;
      const auto [from, to] = std::minmax({(edge.a - start).dot(along), (edge.b - start).dot(along)});
      if (to < face.low - tolerance || from > face.high + tolerance) continue;
      if (from < face.low - tolerance) face.low = from;
      if (to > face.high + tolerance) face.high = to;
    }
  return face;
}

/// The integral from 0 to x of a particle's share in what acts at x spacings from it: 1/2 on its own width,
/// and falling to 0 over the next. The shares of particles one spacing apart sum up to 1, and with signs that
/// alternate to 0: a load keeps its force and its place, and does not set off motion that alternates.
double share_up_to(double x) {
  const double next = std::clamp(std::abs(x) - 0.5, 0.0, 1.0);
  return std::copysign(std::min(std::abs(x), 0.5) / 2 + next / 2 - next * next / 4, x);
}

/// A particle's share of the load on a stretch, over that of its whole width. Beyond the ends of the face the
/// load is mirrored, so that none is lost there.
double spread_share(double along, double length, const Face& face, double width) {
  const auto on = [&](double from, double to) {
    return share_up_to((to - along) / width) - share_up_to((from - along) / width);
  };
  const bool from_end = face.low == 0, to_end = face.high == length;  // one with its image there
  double share = on(from_end ? -length : 0, to_end ? 2 * length : length);
  if (!from_end) share += on(2 * face.low - length, 2 * face.low);
  if (!to_end) share += on(2 * face.high - length, 2 * face.high);
  const double inside = std::min(along - face.low, face.high - along);
  const bool in_corner = std::abs(inside) < 1e-6 * width;  // with half a width, all of it on the face
  return share * (in_corner ? 1 : share_on(along - face.low, face.high - face.low, width));
}

/// The share of a particle's surface that lies on a stretch, of whose width it has `share`; the bends in
/// reach have the rest.
double share_beside(const std::vector<OutlineEdge>& bends, const Vec2& place, double share, double width,
                    double reach) {
  double all = share;
  for (const OutlineEdge& edge : bends) {
    if (distance(place, place, edge.a, edge.b) > reach) continue;
    const Vec2 way = edge.b - edge.a;
    all += share_on((place - edge.a).dot(way.normalized()), way.norm(), width);
  }
  return share / all;
}

/// Areas beside corners are off by some per cent. They are changed, linearly along the stretch, so that a
/// uniform load has its force, and its moment where both ends are at corners or all of it is near one.
void keep_force_and_moment(const std::vector<double>& along, const std::vector<char>& at_corner,
                           double length, std::vector<double>& areas) {
  double force = length, moment = 0, sum = 0, first = 0, second = 0;  // what lacks; of those at corners
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const double arm = along[k] - length / 2, area = areas[k];
    force -= area, moment -= area * arm;
    if (at_corner[k]) sum += area, first += area * arm, second += area * arm * arm;
  }
  if (sum < 0.1 * length) return;
  const double spread = second - first * first / sum;
  const double slope = spread > sum * length * length / 16 ? (moment - first * force / sum) / spread : 0;
  const double change = (force - slope * first) / sum;
  for (std::size_t k = 0; k < areas.size(); ++k)
    if (at_corner[k]) areas[k] *= 1 + change + slope * (along[k] - length / 2);
}

}  // namespace

std::vector<Vec2> vectors_with_sheets(const Case& scene, const Model& model) {
  const std::vector<Vec2> x = accelerations_under({-1, 0, 0, 0}, scene.formulation, model);
  const std::vector<Vec2> y = accelerations_under({0, -1, 0, 0}, scene.formulation, model);
  std::vector<Vec2> vectors(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) vectors[i] = model.particles.mass[i] * Vec2(x[i].x(), y[i].y());
  return vectors;
}

std::vector<Vec2> surface_vectors(const Case& scene, const Model& model) {
  Model bare = model;
  bare.visibility = model.visibility.without_sheets();
  return vectors_with_sheets(scene, bare);
}

StretchOfParticles particles_on(const Point& start, const Point& end, const Vec2& normal, const Case& scene,
                                const Model& model, std::span<const Vec2> vectors, Ends ends) {
  const std::vector<OutlineEdge> edges = free_edges(scene);
  const Edges around = edges_around(scene, edges, normal);
  const Face face = face_of(start, end, edges, 1e-6 * scene.particles.spacing);
  const Particles& p = model.particles;
  // L differs from that inside within 2 h of the surface, and their neighbours feel it.
  const double reach = 4 * model.smoothing_length, spacing = model.spacing;
  const Vec2 way = end - start;
  const double length = way.norm();
  StretchOfParticles found;
  std::vector<double> places;
  std::vector<char> at_corner;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 from_start = p.position[i] - start;
    const double away = std::abs(from_start.dot(normal));
    if (away > reach || vectors[i].norm() < some_area * spacing) continue;
    if (nearest_of(around.in_line, p.position[i], reach).distance < away - 1e-9 * spacing)
      continue;  // its surface is the opposite face
    const double along = from_start.dot(way) / length, own = share_on(along, length, spacing);
    const Nearest bend = nearest_of(around.bends, p.position[i], reach),
                  corner = nearest_of(around.corners, p.position[i], reach);
    Vec2 facing = normal;
    double area = 0;
    if (bend.edge && bend.distance < corner.distance) {
      if (own == 0) continue;
      // What faces that meet almost in line have of a surface vector cannot be told by their normals.
      const double sign = std::copysign(1, vectors[i].dot(normal));
      facing = sign * vectors[i].normalized();
      area = share_beside(around.bends, p.position[i], own, spacing, reach) * sign * vectors[i].norm();
    } else {
      const double share = ends == Ends::spread ? spread_share(along, length, face, spacing) : own;
      area = share * area_on(vectors[i], normal, corner.edge);
    }
    if (area == 0) continue;
    found.particles.push_back(static_cast<std::int32_t>(i));
    found.along.push_back(std::clamp(along, 0.0, length));
    found.normals.push_back(facing);
    found.areas.push_back(area);
    places.push_back(along), at_corner.push_back(facing == normal && corner.edge);
  }
  if (ends == Ends::spread) keep_force_and_moment(places, at_corner, length, found.areas);
  return found;
}

std::vector<LoadedParticles> surface_loads(const Case& scene, const Model& model) {
  if (scene.loads.empty()) return {};
  const std::vector<Vec2> vectors = surface_vectors(scene, model);
  std::vector<LoadedParticles> loads;
  for (const LoadCase& load : scene.loads) {
    const Vec2 normal = outward_normal(scene, load.from, load.to);
    StretchOfParticles on = particles_on(load.from, load.to, normal, scene, model, vectors, Ends::spread);
    LoadedParticles loaded{.load = std::make_shared<Traction>(load),
                           .particles = std::move(on.particles),
                           .places = {},
                           .normals = std::move(on.normals),
                           .areas = std::move(on.areas)};
    const Vec2 way = load.to - load.from;
    for (const double along : on.along) loaded.places.push_back(load.from + along / way.norm() * way);
    if (loaded.particles.empty())
      throw std::runtime_error(
          fmt::format("load '{}': no particle is near its stretch of the outline", load.name));
    loads.push_back(std::move(loaded));
  }
  return loads;
}

void add_surface_loads(std::span<const LoadedParticles> loads, const Particles& p, double time,
                       std::span<Vec2> accelerations) {
  for (const LoadedParticles& l : loads)
    for (std::size_t k = 0; k < l.particles.size(); ++k) {
      const std::int32_t a = l.particles[k];
      accelerations[a] += l.areas[k] / p.mass[a] * l.load->traction(l.places[k], l.normals[k], time);
    }
}

double load_energy(std::span<const LoadedParticles> loads, const Particles& p, double time) {
  double energy = 0;
  for (const LoadedParticles& l : loads)
    for (std::size_t k = 0; k < l.particles.size(); ++k)
      energy -=
          l.areas[k] * l.load->traction(l.places[k], l.normals[k], time).dot(p.displacement(l.particles[k]));
  return energy;
}

double load_squares(std::span<const LoadedParticles> loads, double time) {
  double sum = 0;
  for (const LoadedParticles& l : loads)
    for (std::size_t k = 0; k < l.particles.size(); ++k)
      sum += (l.areas[k] * l.load->traction(l.places[k], l.normals[k], time)).squaredNorm();
  return sum;
}

}  // namespace porosph
