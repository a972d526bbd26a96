#include "solver/run/consolidation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/boundary/load.hpp"
#include "solver/run/leapfrog.hpp"
#include "solver/space/parallel.hpp"
#include "solver/water/flow/default_faces.hpp"

namespace porosph {
namespace {

constexpr double gamma_of_sdirk = 1 - 1 / std::numbers::sqrt2;
constexpr double waves_between_solves = 1.2;  // crossings of the body by a sweep's wave
constexpr double usual_porosity = 0.4;
constexpr double share_of_split = 0.1;  // of the tolerance: what one turn leaves, the next ones add up
constexpr int most_turns = 1000;
constexpr double krylov_tolerance = 1e-5;

double rms(std::span<const double> x) {
  return std::sqrt(deterministic_sum(x.size(), [&](std::size_t i) { return x[i] * x[i]; }) /
                   static_cast<double>(x.size()));
}

/// With every kr = 1: heads are excess heads, measured from the level of the water that stands.
DarcyFlow saturated_flow(const Case& scene, const HydraulicOutline& outline, const Particles& p) {
  const std::vector<double> below(p.size(), -1e9);
  return {make_flow_pairs(scene.soils, outline, p, scene.particles.spacing), outline,
          std::vector<Retention>(scene.soils.size()), p.soil, below};
}

}  // namespace

Consolidation::Consolidation(const Case& scene, Model& model, Dynamics& dynamics, double dt)
    : model_(model),
      dynamics_(dynamics),
      dt_(dt),
      settings_(scene.water.coupling),
      unit_weight_(scene.water.unit_weight),
      outline_(hydraulic_outline(scene.soils, faces_of_excess(scene), scene.particles.spacing)),
      faces_(outline_, faces_of_excess(scene), true),
      flow_(saturated_flow(scene, outline_, model.particles)) {
  const Particles& p = model.particles;
  const std::size_t n = p.size();
  double fastest = 0;
  for (std::size_t a = 0; a < n; ++a) {
    const SoilCase& soil = scene.soils[p.soil[a]];
    const double volume = p.volume(a), modulus = model.soils[p.soil[a]].constrained_modulus();
    start_volume_.push_back(volume);
    const double porosity = soil.porosity > 0 ? soil.porosity : usual_porosity;
    storage_.push_back(unit_weight_ * porosity * volume / scene.water.coupling.bulk_modulus);
    split_.push_back(unit_weight_ * volume / modulus);
    fastest = std::max(fastest, soil.permeability.maxCoeff() * modulus / unit_weight_);
  }
  pinned_ = flow_.pinning_patches(faces_);
  head_.assign(n, 0), water_.assign(n, 0);
  inflow_.resize(n), residual_.resize(n), change_.resize(n);
  accelerations_.resize(n);
  Vec2 low = p.position.front(), high = low;
  for (const Vec2& x : p.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  extent_ = (high - low).maxCoeff();
  step_ = settings_.first_step > 0 ? settings_.first_step : model.spacing * model.spacing / fastest;
}

double Consolidation::volume_gained(std::size_t a) const {
  return model_.particles.volume(a) - start_volume_[a];
}

double Consolidation::imbalance() const {
  double missing = -drained_;
  for (std::size_t a = 0; a < head_.size(); ++a) missing -= water_[a];
  return missing;
}

/// While the soil moves, sigma' + p_e is its stress, and p_w that of the water that stands.
void Consolidation::take_up_pressure() {
  Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double excess = -unit_weight_ * head_[a];
    p.stress[a] = p.stress[a].plus_isotropic(excess);
    p.pore_pressure[a] -= excess;
  }
}

void Consolidation::give_back_pressure() {
  Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double excess = -unit_weight_ * head_[a];
    p.stress[a] = p.stress[a].plus_isotropic(-excess);
    p.pore_pressure[a] += excess;
  }
}

/// RMS of the forces per volume, over the pressure per extent of the body [-].
double Consolidation::out_of_balance() const {
  const Particles& p = model_.particles;
  const double squares = deterministic_sum(
      p.size(), [&](std::size_t a) { return (p.density[a] * accelerations_[a]).squaredNorm(); });
  return std::sqrt(squares / static_cast<double>(p.size())) * extent_ / (unit_weight_ * scale_);
}

void Consolidation::relax(int sweeps, double time) {
  Particles& p = model_.particles;
  for (int k = 0; k <= sweeps; ++k) {
    dynamics_.prepare();
    dynamics_.accelerations(accelerations_);
    add_loads(model_.loads, p, time, accelerations_);
    if (!before_.empty()) relaxation_.measure(p, before_, accelerations_, dt_);
    before_.clear();
    if (k == sweeps) return;
    if (counts_.soil_sweeps % Relaxation::steps_between == 0) before_ = accelerations_;
    const Kick kick = full_kick(relaxation_.damping, dt_);
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < p.size(); ++a) {
      p.velocity[a] = kick(p.velocity[a], accelerations_[a]);
      p.position[a] += dt_ * p.velocity[a];
    }
    model_.pore_water->follow(model_.water, p, 0, p.size());
    dynamics_.strain(dt_);
    ++counts_.soil_sweeps;
  }
}

/// (S + beta + tau H) change = known - dV - S h + tau R(h)
void Consolidation::solve_flow(std::span<const double> known, double tau) {
  flow_.assemble(head_, faces_, DarcyFlow::Slope::secant, slope_, inflow_);
  for (std::size_t a = 0; a < head_.size(); ++a) {
    residual_[a] =
        pinned_[a] >= 0 ? 0 : known[a] - volume_gained(a) - storage_[a] * head_[a] + tau * inflow_[a];
    slope_.diagonal[a] = tau * slope_.diagonal[a] + storage_[a] + split_[a];
  }
  for (double& v : slope_.value) v *= tau;
  std::ranges::fill(change_, 0.0);
  const KrylovResult solved = conjugate_gradients(slope_, residual_, change_, krylov_tolerance, 20000);
  if (!solved.converged)
    throw std::runtime_error(
        fmt::format("consolidation: the pressure equations do not converge ({:.1e} left)", solved.residual));
  ++counts_.pressure_solves, counts_.krylov_iterations += solved.iterations;
  Particles& p = model_.particles;
  for (std::size_t a = 0; a < head_.size(); ++a) {
    head_[a] += change_[a];
    p.stress[a] = p.stress[a].plus_isotropic(-unit_weight_ * change_[a]);
    scale_ = std::max(scale_, std::abs(head_[a]));
  }
}

/// Flow and soil in turn until both keep still.
void Consolidation::settle(std::span<const double> known, double tau) {
  const int sweeps = static_cast<int>(std::ceil(waves_between_solves * extent_ / model_.spacing));
  const double enough = share_of_split * settings_.tolerance;
  for (int turn = 0; turn < most_turns; ++turn) {
    solve_flow(known, tau);
    relax(sweeps, time_);
    double largest = 0;
    for (const double c : change_) largest = std::max(largest, std::abs(c));
    unbalanced_ = scale_ > 0 ? out_of_balance() : 0;
    if (!std::isfinite(unbalanced_)) break;
    if (turn > 0 && largest <= enough * scale_ && unbalanced_ <= enough) return;
    if (turn > 0 && scale_ == 0 && largest == 0) return;
  }
  throw std::runtime_error(fmt::format(
      "consolidation: the soil does not come to rest at {:.6g} s: it fails, or tolerance is too small",
      time_));
}

/// The loads act at once; no water has left yet.
void Consolidation::start() {
  relax(static_cast<int>(std::ceil(waves_between_solves * extent_ / model_.spacing)), time_);
  settle(water_, 0);
  started_ = true;
}

double Consolidation::advance(double now, double until) {
  time_ = now;
  take_up_pressure();
  try {
    if (!started_) start();
    now = flow_step(now, until);
  } catch (...) {
    give_back_pressure();
    throw;
  }
  give_back_pressure();
  return now;
}

double Consolidation::flow_step(double now, double until) {
  const double left = until - now;
  const double step = left <= step_ ? left : std::min(step_, left / 2);  // no tiny last one
  const double tau = gamma_of_sdirk * step;
  const std::size_t n = head_.size();
  std::vector<double> known = water_, first(n);

  time_ = now + tau;
  settle(known, tau);
  flow_.assemble(head_, faces_, DarcyFlow::Slope::secant, slope_, inflow_);
  first = inflow_;
  const auto add_through = [&](double weight) {
    for (const double q : flow_.through_patches(head_, faces_)) drained_ -= weight * q;
  };
  add_through((1 - gamma_of_sdirk) * step);

  time_ = now + step;
  for (std::size_t a = 0; a < n; ++a) known[a] = water_[a] + (step - tau) * first[a];
  settle(known, tau);
  flow_.assemble(head_, faces_, DarcyFlow::Slope::secant, slope_, inflow_);
  add_through(tau);
  for (std::size_t a = 0; a < n; ++a) water_[a] = known[a] + tau * inflow_[a];
  for (std::size_t a = 0; a < n; ++a)  // what lies on a face that drains gives its water away at once
    if (pinned_[a] >= 0) {
      const double gained = volume_gained(a) + storage_[a] * head_[a];
      drained_ -= gained - water_[a], water_[a] = gained;
    }

  for (std::size_t a = 0; a < n; ++a) change_[a] = tau * (inflow_[a] - first[a]) / split_[a];
  const double error = scale_ > 0 ? rms(change_) / scale_ : 0;
  const double wanted = error > 0 ? 0.9 * std::sqrt(settings_.tolerance / error) : settings_.growth;
  const double next = step * std::clamp(wanted, 0.3, settings_.growth);
  step_ = step < step_ ? std::max(next, std::min(step_, step * wanted)) : next;
  ++counts_.flow_steps;
  return step < left ? now + step : until;
}

void Consolidation::visit(StateArchive& state) {
  state.array("excess_head", head_);
  state.array("water_gained", water_);
  state.array("accelerations_at_rest", accelerations_);
  state.value("flow_step", step_);
  state.value("largest_head", scale_);
  state.value("drained", drained_);
  state.value("unbalanced", unbalanced_);
  state.value("loaded", started_);
  state.value("flow_steps", counts_.flow_steps);
  state.value("pressure_solves", counts_.pressure_solves);
  state.value("krylov_iterations", counts_.krylov_iterations);
  state.value("soil_sweeps", counts_.soil_sweeps);
  state.value("flow_relaxation_stiffness", relaxation_.stiffness);
  state.value("flow_relaxation_inertia", relaxation_.inertia);
  state.value("flow_relaxation_damping", relaxation_.damping);
}

}  // namespace porosph
