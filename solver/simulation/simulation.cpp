#include "solver/simulation/simulation.hpp"

#include <cmath>

#include "solver/monitor/energy.hpp"
#include "solver/simulation/leapfrog.hpp"

namespace porosph {

double time_step(const Case& scene, const Model& model) {
  const double largest = scene.time.courant * model.smoothing_length / model.wave_speed;
  return scene.time.end / std::ceil(scene.time.end / largest * (1 - 1e-12));
}

Simulation::Simulation(const Case& scene, const DynamicsMaker& dynamics)
    : scene_(scene),
      model_(build_model(scene)),
      dynamics_(dynamics(scene.formulation, model_)),
      dt_(porosph::time_step(scene, model_)),
      last_step_(std::llround(scene.time.end / dt_)),
      accelerations_(model_.particles.size(), Vec2::Zero()) {
  for (const ProbeCase& probe : scene.probes) probes_.emplace_back(probe, model_);
  closest_at_start_ = closest_distance(model_.particles.position, 2 * model_.spacing);
  if (scene.stop.on_separation)
    bodies_at_start_ = find_bodies(model_.particles.position, 2 * model_.smoothing_length).count;
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
  if (!instability_) dynamics_->strain(dt_);
}

/// v^{n+1/2} and x^{n+1}, and the pore pressure there.
void Simulation::drift() {
  Particles& p = model_.particles;
  const double c = damping(), dt = dt_;
  const bool first = step_ == 0, wet = model_.water.present();
  model_.water.set_time(time() + dt);
  bool runaway = false;
#pragma omp parallel for schedule(static) reduction(|| : runaway)
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = (first ? first_kick : kick)(p.velocity[i], accelerations_[i], c, dt);
    p.position[i] += dt * p.velocity[i];
    if (wet) p.pore_pressure[i] = model_.water.pore_pressure(p.position[i].x(), p.position[i].y());
    runaway = runaway || !(p.velocity[i].squaredNorm() < model_.wave_speed * model_.wave_speed) ||
              !(p.density[i] > 0);
  }
  runaway_ = runaway;
  if (runaway) name_breakdown(time() + dt);
}

/// What the conventional form throws off is fast in the end, but that it left is what went wrong first.
void Simulation::name_breakdown(double time) {
  instability_ = find_runaway(model_, time);
  const bool throws_off = scene_.formulation.motion == Motion::conventional && scene_.stop.on_separation;
  if (!throws_off || instability_->cause != Cause::too_fast) return;
  for (const Vec2& x : model_.particles.position)
    if (!x.allFinite()) return;
  if (auto separation = find_separation(model_, bodies_at_start_, time)) instability_ = std::move(separation);
}

void Simulation::look_for_breakdown() {
  constexpr double met = 0.25;  // of the smallest distance at the start
  if (!instability_) instability_ = find_crossing(model_, met * closest_at_start_, time());
  if (scene_.stop.on_separation && !instability_)
    instability_ = find_separation(model_, bodies_at_start_, time());
}

void Simulation::remember() {
  good_before_ = std::move(good_);
  const auto a = accelerations();
  good_ = State{model_.particles, {a.begin(), a.end()}, step_};
}

bool Simulation::exchange_with_last_good() {
  std::optional<State>& good = good_before_ ? good_before_ : good_;
  if (!good) return false;
  std::swap(model_.particles, good->particles);
  std::swap(accelerations_, good->accelerations);
  std::swap(step_, good->step);
  accelerations_valid_ = true;
  return true;
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
