#include "solver/water/steady_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace porosph {
namespace {

DarcyFlow make_flow(const Case& scene, const HydraulicOutline& outline, const Particles& p) {
  std::vector<Retention> retention;
  for (const SoilCase& soil : scene.soils) retention.emplace_back(soil.retention, scene.particles.spacing);
  std::vector<double> height;
  for (const Vec2& x : p.position) height.push_back(x.y());
  return {make_flow_pairs(scene.soils, outline, p, scene.particles.spacing), outline, std::move(retention),
          p.soil, height};
}

HydraulicOutline outline_of(const Case& scene) {
  return hydraulic_outline(scene.soils, scene.water.faces, scene.particles.spacing);
}

}  // namespace

SteadyWater::SteadyWater(const Case& scene, const Particles& p)
    : unit_weight_(scene.water.unit_weight), flow_(make_flow(scene, outline_of(scene), p)) {
  const HydraulicOutline outline = outline_of(scene);
  const FaceConditions faces(outline, scene.water.faces);
  if (const std::int32_t a = flow_.unreached(faces); a >= 0)
    throw std::runtime_error(fmt::format(
        "steady seepage: the soil around ({:.6g}, {:.6g}) is reached by no [[water.face]] of kind "
        "\"head\" or \"seepage\"",
        p.position[a].x(), p.position[a].y()));
  std::vector<double> height;
  for (const Vec2& x : p.position) height.push_back(x.y());
  SteadySeepage found = solve_steady(flow_, faces, start_of_steady(scene.water.faces, height));

  record_.head = std::move(found.head);
  record_.velocity = flow_.velocities(record_.head, found.faces, p.position);
  record_.gradient = flow_.velocities(record_.head, found.faces, p.position, true);
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Point& k = scene.soils[p.soil[a]].permeability;
    record_.gradient[a] = Vec2(record_.gradient[a].x() / k.x(), record_.gradient[a].y() / k.y());
    record_.saturation.push_back(flow_.retention(a).saturation(record_.head[a] - height[a]));
  }
  record_.through_faces = through_faces(flow_, outline, record_.head, found.faces, scene.water.faces.size());
  double in = 0, net = 0;
  for (const double q : record_.through_faces) in += std::max(q, 0.0), net += q;
  record_.imbalance = in > 0 ? net / in : 0;
  record_.newton_steps = found.newton_steps, record_.krylov_iterations = found.krylov_iterations;
}

void SteadyWater::wet(const Case& scene, Particles& p) const {
  for (std::size_t a = 0; a < p.size(); ++a) {
    const SoilCase& soil = scene.soils[p.soil[a]];
    const double area = p.volume(a), psi = record_.head[a] - p.position[a].y();
    const double part = std::clamp(0.5 + psi / std::sqrt(area), 0.0, 1.0);
    p.density[a] = (part * soil.unit_weight_saturated + (1 - part) * soil.unit_weight_unsaturated) /
                   scene.loading.gravity;
    p.mass[a] = p.density[a] * area;
    p.pore_pressure[a] = -unit_weight_ * flow_.retention(a).effective(psi);
  }
}

void SteadyWater::follow(const StandingWater&, Particles& p, std::size_t first, std::size_t last) const {
  for (std::size_t a = first; a < last; ++a)
    p.pore_pressure[a] = -unit_weight_ * flow_.retention(a).effective(record_.head[a] - p.position[a].y());
}

void SteadyWater::fill_ghosts(const StandingWater&, const Particles& p, const Ghosts& ghosts,
                              std::span<const Vec2> places, std::span<double> pressure) const {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const auto root = static_cast<std::size_t>(ghosts.root(i));
    const double head = record_.head[root] - record_.gradient[root].dot(places[i] - p.position[root]);
    pressure[p.size() + i] = -unit_weight_ * flow_.retention(root).effective(head - places[i].y());
  }
}

}  // namespace porosph
