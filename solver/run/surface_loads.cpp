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

/// The part of a particle's surface vector that belongs to a face with this normal: beside a corner the rest
/// is that of the other face in reach.
double area_on(const Vec2& surface_vector, const Vec2& normal, const Vec2& place, double away,
               const std::vector<OutlineEdge>& edges, double reach) {
  Vec2 other = Vec2::Zero();
  double nearest = reach;
  for (const OutlineEdge& edge : edges) {
    const Vec2 across = unit_normal(edge.a, edge.b);
    const double d = distance(place, place, edge.a, edge.b);
    if (std::abs(across.dot(normal)) > 1 - 1e-9) {
      if (d < away * (1 - 1e-9)) return 0;  // its surface is the opposite face
      continue;
    }
    if (d < nearest) nearest = d, other = across;
  }
  if (other == Vec2::Zero()) return surface_vector.dot(normal);
  Mat2 faces;
  faces << normal.x(), other.x(), normal.y(), other.y();
  return (faces.inverse() * surface_vector).x();
}

/// The share of a particle's width along the stretch that lies on it.
double share_on(double along, double length, double width) {
  return std::clamp(std::min(along + width / 2, length) - std::max(along - width / 2, 0.0), 0.0, width) /
         width;
}

/// The edges on which the outline goes on beside a face with this normal, where it turns by less than 45
/// degrees.
std::vector<OutlineEdge> bends_of(const Case& scene, const std::vector<OutlineEdge>& edges,
                                  const Vec2& normal) {
  const double blunt = std::sqrt(0.5);
  std::vector<OutlineEdge> bends;
  for (const OutlineEdge& edge : edges) {
    const double turn = outward_normal(scene, edge.a, edge.b).dot(normal);
    if (turn > blunt && turn < 1 - 1e-9) bends.push_back(edge);
  }
  return bends;
}

/// The share of a particle's surface that lies on a stretch, of whose width it has `share`; the bends in
/// reach have the rest. Nothing where none is in reach.
std::optional<double> share_beside(const std::vector<OutlineEdge>& bends, const Vec2& place, double share,
                                   double width, double reach) {
  double all = share;
  bool found = false;
  for (const OutlineEdge& edge : bends) {
    if (distance(place, place, edge.a, edge.b) > reach) continue;
    const Vec2 way = edge.b - edge.a;
    all += share_on((place - edge.a).dot(way.normalized()), way.norm(), width);
    found = true;
  }
  return found ? std::optional(share / all) : std::nullopt;
}

}  // namespace

std::vector<Vec2> surface_vectors(const Case& scene, const Model& model) {
  const std::vector<Vec2> x = accelerations_under({-1, 0, 0, 0}, scene.formulation, model);
  const std::vector<Vec2> y = accelerations_under({0, -1, 0, 0}, scene.formulation, model);
  std::vector<Vec2> vectors(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) vectors[i] = model.particles.mass[i] * Vec2(x[i].x(), y[i].y());
  return vectors;
}

StretchOfParticles particles_on(const Point& start, const Point& end, const Vec2& normal, const Case& scene,
                                const Model& model, std::span<const Vec2> vectors) {
  const std::vector<OutlineEdge> edges = free_edges(scene), bends = bends_of(scene, edges, normal);
  const Particles& p = model.particles;
  // L differs from that inside within 2 h of the surface, and their neighbours feel it.
  const double reach = 4 * model.smoothing_length, spacing = model.spacing;
  const Vec2 way = end - start;
  const double length = way.norm();
  StretchOfParticles found;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 from_start = p.position[i] - start;
    const double away = std::abs(from_start.dot(normal));
    if (away > reach || vectors[i].norm() < some_area * spacing) continue;
    const double along = from_start.dot(way) / length, share = share_on(along, length, spacing);
    if (share == 0) continue;
    found.particles.push_back(static_cast<std::int32_t>(i));
    found.along.push_back(std::clamp(along, 0.0, length));
    // What faces that meet almost in line have of a surface vector cannot be told by their normals.
    const auto part = share_beside(bends, p.position[i], share, spacing, reach);
    found.normals.push_back(part ? vectors[i].normalized() : normal);
    found.areas.push_back(part ? *part * vectors[i].norm()
                               : share * area_on(vectors[i], normal, p.position[i], away, edges, reach));
  }
  return found;
}

std::vector<LoadedParticles> surface_loads(const Case& scene, const Model& model) {
  if (scene.loads.empty()) return {};
  const std::vector<Vec2> vectors = surface_vectors(scene, model);
  std::vector<LoadedParticles> loads;
  for (const LoadCase& load : scene.loads) {
    const Vec2 normal = outward_normal(scene, load.from, load.to);
    StretchOfParticles on = particles_on(load.from, load.to, normal, scene, model, vectors);
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
