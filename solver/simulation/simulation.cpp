#include "solver/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/monitor/energy.hpp"
#include "solver/monitor/instability.hpp"
#include "solver/simulation/leapfrog.hpp"

namespace porosph {

double time_step(const Case& scene, const Model& model) {
  const double largest = scene.time.courant * model.smoothing_length / model.wave_speed;
  return scene.time.end / std::ceil(scene.time.end / largest * (1 - 1e-12));
}

Simulation::Simulation(const Case& scene)
    : scene_(scene),
      model_(build_model(scene)),
      dynamics_(make_dynamics(scene.formulation, model_)),
      dt_(porosph::time_step(scene, model_)),
      last_step_(std::llround(scene.time.end / dt_)),
      accelerations_(model_.particles.size(), Vec2::Zero()) {
  for (const ProbeCase& probe : scene.probes) probes_.emplace_back(probe, model_);
  if (scene.stop.on_separation)
    bodies_at_start_ = find_bodies(model_.particles.position, 2 * model_.smoothing_length).count;
}

void Simulation::set_material(const std::string& soil, std::shared_ptr<Material> material) {
  const auto& soils = scene_.soils;
  const auto found = std::ranges::find(soils, soil, &SoilCase::name);
  if (found == soils.end()) throw std::invalid_argument(fmt::format("no soil is called '{}'", soil));
  if (found->no_tension)
    throw std::invalid_argument(fmt::format("soil '{}' is without tension: it cannot have a material", soil));
  materials_.resize(soils.size());
  materials_[found - soils.begin()] = std::move(material);
}

double Simulation::damping() const {
  return time() < scene_.loading.damping_until ? scene_.loading.damping / dt_ : 0;
}

std::span<const Vec2> Simulation::accelerations() {
  if (!accelerations_valid_) {
    dynamics_->prepare();
    dynamics_->accelerations(accelerations_);
    accelerations_valid_ = true;
  }
  return accelerations_;
}

std::vector<Vec2> Simulation::velocities() {
  std::vector<Vec2> v = model_.particles.velocity;
  if (step_ == 0) return v;
  const auto a = accelerations();
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = half_kick(v[i], a[i], damping(), dt_);
  return v;
}

void Simulation::advance() {
  if (instability_) return;
  accelerations();
  drift();
  accelerations_valid_ = false;
  ++step_;
  if (instability_) return;
  if (!materials_.empty()) apply_materials(materials_, model_, *dynamics_, dt_);
  dynamics_->strain(dt_);
}

/// v^{n+1/2} and x^{n+1}, and the pore pressure there.
void Simulation::drift() {
  Particles& p = model_.particles;
  const double c = damping(), dt = dt_;
  const bool first = step_ == 0, wet = model_.water.present();
  bool runaway = false;
#pragma omp parallel for schedule(static) reduction(|| : runaway)
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = (first ? first_kick : kick)(p.velocity[i], accelerations_[i], c, dt);
    p.position[i] += dt * p.velocity[i];
    if (wet) p.pore_pressure[i] = model_.water.pore_pressure(p.position[i].x(), p.position[i].y());
    runaway = runaway || !(p.velocity[i].squaredNorm() < model_.wave_speed * model_.wave_speed);
  }
  runaway_ = runaway;
  if (runaway) instability_ = find_runaway(model_, time() + dt);
}

void Simulation::look_for_separation() {
  if (scene_.stop.on_separation && !instability_)
    instability_ = find_separation(model_, bodies_at_start_, time());
}

double Simulation::unbalanced_force_ratio() {
  return porosph::unbalanced_force_ratio(model_, accelerations());
}

Simulation::Energy Simulation::energy() {
  const std::vector<Vec2> v = velocities();
  return {.kinetic = kinetic_energy(model_.particles, v),
          .elastic = elastic_energy(model_),
          .gravity = gravity_energy(model_),
          .water = water_energy(model_)};
}

}  // namespace porosph
