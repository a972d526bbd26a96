#include "solver/simulation/simulation.hpp"

#include <cmath>

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

double Simulation::damping() const {
  const LoadingCase& loading = scene_.loading;
  if (time() >= loading.damping_until) return 0;
  return loading.adaptive_damping ? relaxation_.damping : loading.damping / dt_;
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
  const bool measure = scene_.loading.adaptive_damping && step_ % Relaxation::steps_between == 0;
  if (measure) before_ = accelerations_;
  drift();
  accelerations_valid_ = false;
  ++step_;
  if (instability_) return;
  dynamics_->strain(dt_);
  if (measure) relaxation_.measure(model_.particles, before_, accelerations(), dt_);
}

void Simulation::displace(std::span<const Vec2> displacement, int steps) {
  Particles& p = model_.particles;
  for (int k = 0; k < steps; ++k) {
    dynamics_->prepare();
    for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = displacement[i] / (steps * dt_);
    for (std::size_t i = 0; i < p.size(); ++i) p.position[i] += dt_ * p.velocity[i];
    dynamics_->strain(dt_);
  }
  if (model_.water.present())
    for (std::size_t i = 0; i < p.size(); ++i)
      p.pore_pressure[i] = model_.water.pore_pressure(p.position[i].x(), p.position[i].y());
  for (Vec2& v : p.velocity) v.setZero();
  dynamics_->prepare();
  dynamics_->strain(0);
  accelerations_valid_ = false;
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
