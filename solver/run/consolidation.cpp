#include "solver/run/consolidation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "solver/space/parallel.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {
namespace {

constexpr double gamma_of_sdirk = 1 - 1 / std::numbers::sqrt2;
constexpr double share_of_split = 0.1;  // of the tolerance: what one turn leaves, the next ones add up
constexpr int most_turns = 300;
constexpr double krylov_tolerance = 1e-5;
constexpr std::size_t rests_kept = 3;
constexpr double load_steps = 100;  // where the case names no step

double rms(std::span<const double> x) {
  return std::sqrt(deterministic_sum(x.size(), [&](std::size_t i) { return x[i] * x[i]; }) /
                   static_cast<double>(x.size()));
}

/// tau = a gamma_w dx^2 / M of each soil, as a permeability.
PressureStabilisation stabilisation(const Case& scene, const Model& model) {
  if (scene.water.coupling.stabilisation == 0) return {};
  const double all =
      scene.water.coupling.stabilisation * scene.water.unit_weight * model.spacing * model.spacing;
  std::vector<double> tau;
  for (const Soil& soil : model.soils) tau.push_back(all / soil.constrained_modulus());
  return pressure_stabilisation(scene, tau, model.particles);
}

}  // namespace

Consolidation::Consolidation(const Case& scene, Model& model, Dynamics& dynamics, SurfaceForces& surface,
                             double dt)
    : model_(model),
      soil_(model, dynamics, surface, dt),
      settings_(scene.water.coupling),
      unit_weight_(scene.water.unit_weight),
      drainage_(drainage(scene, model.particles)),
      pores_(scene.soils, model.particles),
      stabilisation_(stabilisation(scene, model)) {
  const Particles& p = model.particles;
  const std::size_t n = p.size();
  of_.storage = storage_of_water(scene, p);
  double fastest = 0;
  for (std::size_t a = 0; a < n; ++a) {
    const double modulus = model.soils[p.soil[a]].constrained_modulus();
    of_.split.push_back(unit_weight_ * p.volume(a) / modulus);
    fastest = std::max(fastest, scene.soils[p.soil[a]].permeability.maxCoeff() * modulus / unit_weight_);
  }
  of_.head.assign(n, 0), of_.water.assign(n, 0), of_.smoothed.assign(n, 0), of_.inflow.assign(n, 0);
  of_.residual.resize(n), of_.change.resize(n);
  progress_.step = drainage_ ? model.spacing * model.spacing / fastest : scene.time.end / load_steps;
  if (settings_.first_step > 0) progress_.step = settings_.first_step;
}

/// W as the soil and the head have it [m2].
double Consolidation::water_of(std::size_t a) const {
  return soil_.volume_gained(a) + of_.storage[a] * of_.head[a] + of_.smoothed[a];
}

double Consolidation::imbalance() const {
  double missing = -progress_.drained;
  for (std::size_t a = 0; a < of_.head.size(); ++a) missing -= of_.water[a];
  return missing;
}

Consolidation::Counts Consolidation::counts() const {
  Counts counts = counts_;
  counts.soil_sweeps = soil_.sweeps();
  return counts;
}

/// While the soil moves, p_w is that of the water that stands.
void Consolidation::show_pressure(double sign) {
  Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) p.pore_pressure[a] += sign * soil_.excess()[a];
}

void Consolidation::follow_pores() {
  if (!pores_.follows()) return;
  for (std::size_t a = 0; a < of_.change.size(); ++a) of_.change[a] = soil_.volume_gained(a);
  pores_.follow(of_.change);
  drainage_->flow.set_permeability_ratio(pores_.ratio());
}

/// -dR/dh and R at the present head.
void Consolidation::assemble() {
  follow_pores();
  if (drainage_)
    return drainage_->flow.assemble(of_.head, drainage_->faces, DarcyFlow::Slope::secant, slope_, of_.inflow);
  const std::size_t n = of_.head.size();
  if (stabilisation_.active())
    slope_ = stabilisation_.compact();
  else
    slope_.begin.assign(n + 1, 0);
  std::ranges::fill(slope_.value, 0.0);
  slope_.diagonal.assign(n, 0);
}

/// (S + beta + T + tau H) change = known - dV - S h - T h + tau R(h), with the upper bound of T on the left.
void Consolidation::solve_flow(std::span<const double> known, double tau) {
  assemble();
  const std::size_t n = of_.head.size();
  const auto pinned = [&](std::size_t a) { return drainage_ && drainage_->pinned[a] >= 0; };
  if (stabilisation_.active()) stabilisation_.apply(of_.head, of_.smoothed);
  for (std::size_t a = 0; a < n; ++a) {
    of_.residual[a] = pinned(a) ? 0 : known[a] - water_of(a) + tau * of_.inflow[a];
    slope_.diagonal[a] = tau * slope_.diagonal[a] + of_.storage[a] + of_.split[a];
  }
  for (double& v : slope_.value) v *= tau;
  if (stabilisation_.active()) {
    const SparseRows& compact = stabilisation_.compact();
    for (std::size_t a = 0; a < n; ++a) {
      slope_.diagonal[a] += compact.diagonal[a];
      for (auto k = slope_.begin[a]; k < slope_.begin[a + 1]; ++k)
        if (!pinned(a) && !pinned(slope_.column[k])) slope_.value[k] += compact.value[k];
    }
  }
  std::ranges::fill(of_.change, 0.0);
  const KrylovResult solved = conjugate_gradients(slope_, of_.residual, of_.change, krylov_tolerance, 20000);
  if (!solved.converged)
    throw std::runtime_error(
        fmt::format("consolidation: the pressure equations do not converge ({:.1e} left)", solved.residual));
  ++counts_.pressure_solves, counts_.krylov_iterations += solved.iterations;
  for (std::size_t a = 0; a < n; ++a) {
    of_.head[a] += of_.change[a];
    soil_.excess()[a] = -unit_weight_ * of_.head[a];
    progress_.scale = std::max(progress_.scale, std::abs(of_.head[a]));
  }
}

/// Places and heads continue as through the last rests: a polynomial in time.
void Consolidation::guess() {
  const std::size_t count = rests_.size();
  if (count < 2) return;
  std::vector<double> weight(count, 1);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      if (i != j) weight[i] *= (progress_.time - rests_[j].time) / (rests_[i].time - rests_[j].time);
  std::vector<Vec2> places(of_.head.size(), Vec2::Zero());
  std::ranges::fill(of_.head, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < places.size(); ++a) {
      places[a] += weight[i] * rests_[i].position[a];
      of_.head[a] += weight[i] * rests_[i].head[a];
    }
  for (std::size_t a = 0; a < places.size(); ++a) soil_.excess()[a] = -unit_weight_ * of_.head[a];
  soil_.move_to(places);
}

void Consolidation::settle(std::span<const double> known, double tau) {
  guess();
  take_turns(known, tau);
  if (rests_.size() == rests_kept) rests_.erase(rests_.begin());
  rests_.push_back({progress_.time, model_.particles.position, of_.head});
}

/// Flow and soil in turn until both keep still.
void Consolidation::take_turns(std::span<const double> known, double tau) {
  const double enough = share_of_split * settings_.tolerance;
  for (int turn = 0; turn < most_turns; ++turn) {
    solve_flow(known, tau);
    double largest = 0;
    for (const double c : of_.change) largest = std::max(largest, std::abs(c));
    if (turn > 0 && largest <= enough * progress_.scale && progress_.unbalanced <= enough) return;
    soil_.relax(soil_.crossing(), progress_.time);
    progress_.unbalanced =
        progress_.scale > 0 ? soil_.out_of_balance() / (unit_weight_ * progress_.scale) : 0;
    if (!std::isfinite(progress_.unbalanced)) break;
  }
  const std::size_t a = soil_.fastest();
  const Vec2 place = model_.particles.start[a] + model_.origin;  // it may have run away
  throw std::runtime_error(
      fmt::format("the soil does not come to rest at {:.6g} s: it fails around {}, or water.tolerance is "
                  "too small",
                  progress_.time, place_text(place)));
}

/// The loads act at once; no water has left yet.
void Consolidation::start() {
  soil_.relax(soil_.crossing(), progress_.time);
  settle(of_.water, 0);
  progress_.started = true;
}

double Consolidation::advance(double now, double until) {
  progress_.time = now;
  show_pressure(-1);
  try {
    if (!progress_.started) start();
    now = drainage_ ? flow_step(now, until) : load_step(now, until);
  } catch (...) {
    show_pressure(1);
    throw;
  }
  show_pressure(1);
  ++counts_.flow_steps;
  if (progress_.failed_step > 0 && now >= progress_.failed_at)
    progress_.step = std::exchange(progress_.failed_step, 0);
  return now;
}

bool Consolidation::seek_failure(double now, double lost) {
  constexpr double closest = 1.0 / 16 - 1e-6;
  if (progress_.failed_step == 0) progress_.failed_step = lost - now, progress_.failed_at = lost;
  progress_.step = (lost - now) / 2;
  return progress_.step > closest * progress_.failed_step;
}

double Consolidation::load_step(double now, double until) {
  const double left = until - now, step = std::min(left, progress_.step);
  progress_.time = now + step;
  settle(of_.water, 0);
  return step < left ? now + step : until;
}

double Consolidation::flow_step(double now, double until) {
  const double left = until - now;
  const double step = left <= progress_.step ? left : std::min(progress_.step, left / 2);  // no tiny last one
  const double tau = gamma_of_sdirk * step;
  const std::size_t n = of_.head.size();
  std::vector<double> known = of_.water;
  const auto add_through = [&](double weight) {
    for (const double q : drainage_->flow.through_patches(of_.head, drainage_->faces))
      progress_.drained -= weight * q;
  };

  progress_.time = now + tau;
  settle(known, tau);
  assemble();
  const std::vector<double> first = of_.inflow;
  add_through((1 - gamma_of_sdirk) * step);

  progress_.time = now + step;
  for (std::size_t a = 0; a < n; ++a) known[a] = of_.water[a] + (step - tau) * first[a];
  settle(known, tau);
  assemble();
  add_through(tau);
  for (std::size_t a = 0; a < n; ++a) of_.water[a] = known[a] + tau * of_.inflow[a];
  if (stabilisation_.active()) stabilisation_.apply(of_.head, of_.smoothed);
  for (std::size_t a = 0; a < n; ++a)  // what lies on a face that drains gives its water away at once
    if (drainage_->pinned[a] >= 0) {
      const double gained = water_of(a);
      progress_.drained -= gained - of_.water[a], of_.water[a] = gained;
    }
  choose_step(step, first);
  return step < left ? now + step : until;
}

/// By the difference of the second-order step from the embedded one of backward Euler.
void Consolidation::choose_step(double step, std::span<const double> first) {
  const double tau = gamma_of_sdirk * step;
  for (std::size_t a = 0; a < of_.head.size(); ++a)
    of_.change[a] = tau * (of_.inflow[a] - first[a]) / of_.split[a];
  const double error = progress_.scale > 0 ? rms(of_.change) / progress_.scale : 0;
  const double wanted = error > 0 ? 0.9 * std::sqrt(settings_.tolerance / error) : settings_.growth;
  const double next = step * std::clamp(wanted, 0.3, settings_.growth);
  progress_.step = step < progress_.step ? std::max(next, std::min(progress_.step, step * wanted)) : next;
}

void Consolidation::visit(StateArchive& state) {
  state.array("excess_head", of_.head);
  state.array("water_gained", of_.water);
  state.value("flow_step", progress_.step);
  state.value("largest_head", progress_.scale);
  state.value("drained", progress_.drained);
  state.value("unbalanced", progress_.unbalanced);
  state.value("loaded", progress_.started);
  state.value("failed_step", progress_.failed_step);
  state.value("failed_at", progress_.failed_at);
  state.value("flow_steps", counts_.flow_steps);
  state.value("pressure_solves", counts_.pressure_solves);
  state.value("krylov_iterations", counts_.krylov_iterations);
  auto rests = static_cast<std::int64_t>(rests_.size());
  state.value("rests", rests);
  if (rests < 0 || rests > static_cast<std::int64_t>(rests_kept))
    throw StateError("consolidation: more states at rest than a run keeps");
  const std::size_t n = of_.head.size();
  rests_.resize(rests, {0, std::vector<Vec2>(n), std::vector<double>(n)});
  for (Rest& rest : rests_) {
    state.value("rest_time", rest.time);
    state.array("rest_position", rest.position);
    state.array("rest_head", rest.head);
  }
  soil_.visit(state);
  if (state.restoring() && stabilisation_.active()) stabilisation_.apply(of_.head, of_.smoothed);
}

}  // namespace porosph
