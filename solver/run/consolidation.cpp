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

}  // namespace

/// With every kr = 1: heads are excess heads, measured from the level of the water that stands.
Consolidation::Drainage Consolidation::drainage(const Case& scene, const Particles& p) {
  const std::vector<HydraulicFaceCase> faces = faces_of_excess(scene);
  const HydraulicOutline outline = hydraulic_outline(scene.soils, faces, scene.particles.spacing);
  const std::vector<double> below(p.size(), -1e9);
  Drainage d{.outline = outline,
             .faces = FaceConditions(outline, faces, true),
             .flow = {make_flow_pairs(scene.soils, outline, p, scene.particles.spacing), outline,
                      std::vector<Retention>(scene.soils.size()), p.soil, below}};
  d.pinned = d.flow.pinning_patches(d.faces);
  return d;
}

Consolidation::Consolidation(const Case& scene, Model& model, Dynamics& dynamics, double dt)
    : soil_{.model = model, .dynamics = dynamics, .dt = dt},
      settings_(scene.water.coupling),
      unit_weight_(scene.water.unit_weight),
      drainage_(drainage(scene, model.particles)) {
  const Particles& p = model.particles;
  const std::size_t n = p.size();
  double fastest = 0;
  for (std::size_t a = 0; a < n; ++a) {
    const SoilCase& soil = scene.soils[p.soil[a]];
    const double volume = p.volume(a), modulus = model.soils[p.soil[a]].constrained_modulus();
    of_.start_volume.push_back(volume);
    const double porosity = soil.porosity > 0 ? soil.porosity : usual_porosity;
    of_.storage.push_back(unit_weight_ * porosity * volume / scene.water.coupling.bulk_modulus);
    of_.split.push_back(unit_weight_ * volume / modulus);
    fastest = std::max(fastest, soil.permeability.maxCoeff() * modulus / unit_weight_);
  }
  of_.head.assign(n, 0), of_.water.assign(n, 0);
  of_.inflow.resize(n), of_.residual.resize(n), of_.change.resize(n);
  soil_.accelerations.resize(n);
  Vec2 low = p.position.front(), high = low;
  for (const Vec2& x : p.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  soil_.extent = (high - low).maxCoeff();
  progress_.step = settings_.first_step > 0 ? settings_.first_step : model.spacing * model.spacing / fastest;
}

double Consolidation::volume_gained(std::size_t a) const {
  return soil_.model.particles.volume(a) - of_.start_volume[a];
}

double Consolidation::imbalance() const {
  double missing = -progress_.drained;
  for (std::size_t a = 0; a < of_.head.size(); ++a) missing -= of_.water[a];
  return missing;
}

/// While the soil moves, sigma' + p_e is its stress, and p_w that of the water that stands.
void Consolidation::take_up_pressure() {
  Particles& p = soil_.model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double excess = -unit_weight_ * of_.head[a];
    p.stress[a] = p.stress[a].plus_isotropic(excess);
    p.pore_pressure[a] -= excess;
  }
}

void Consolidation::give_back_pressure() {
  Particles& p = soil_.model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double excess = -unit_weight_ * of_.head[a];
    p.stress[a] = p.stress[a].plus_isotropic(-excess);
    p.pore_pressure[a] += excess;
  }
}

/// RMS of the forces per volume, over the pressure per extent of the body [-].
double Consolidation::out_of_balance() const {
  const Particles& p = soil_.model.particles;
  const double squares = deterministic_sum(
      p.size(), [&](std::size_t a) { return (p.density[a] * soil_.accelerations[a]).squaredNorm(); });
  return std::sqrt(squares / static_cast<double>(p.size())) * soil_.extent / (unit_weight_ * progress_.scale);
}

void Consolidation::relax(int sweeps, double time) {
  Particles& p = soil_.model.particles;
  for (int k = 0; k <= sweeps; ++k) {
    soil_.dynamics.prepare();
    soil_.dynamics.accelerations(soil_.accelerations);
    add_loads(soil_.model.loads, p, time, soil_.accelerations);
    if (!soil_.before.empty()) soil_.relaxation.measure(p, soil_.before, soil_.accelerations, soil_.dt);
    soil_.before.clear();
    if (k == sweeps) return;
    if (counts_.soil_sweeps % Relaxation::steps_between == 0) soil_.before = soil_.accelerations;
    const Kick kick = full_kick(soil_.relaxation.damping, soil_.dt);
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < p.size(); ++a) {
      p.velocity[a] = kick(p.velocity[a], soil_.accelerations[a]);
      p.position[a] += soil_.dt * p.velocity[a];
    }
    soil_.model.pore_water->follow(soil_.model.water, p, 0, p.size());
    soil_.dynamics.strain(soil_.dt);
    ++counts_.soil_sweeps;
  }
}

/// (S + beta + tau H) change = known - dV - S h + tau R(h)
void Consolidation::solve_flow(std::span<const double> known, double tau) {
  drainage_.flow.assemble(of_.head, drainage_.faces, DarcyFlow::Slope::secant, drainage_.slope, of_.inflow);
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    of_.residual[a] = drainage_.pinned[a] >= 0
                          ? 0
                          : known[a] - volume_gained(a) - of_.storage[a] * of_.head[a] + tau * of_.inflow[a];
    drainage_.slope.diagonal[a] = tau * drainage_.slope.diagonal[a] + of_.storage[a] + of_.split[a];
  }
  for (double& v : drainage_.slope.value) v *= tau;
  std::ranges::fill(of_.change, 0.0);
  const KrylovResult solved =
      conjugate_gradients(drainage_.slope, of_.residual, of_.change, krylov_tolerance, 20000);
  if (!solved.converged)
    throw std::runtime_error(
        fmt::format("consolidation: the pressure equations do not converge ({:.1e} left)", solved.residual));
  ++counts_.pressure_solves, counts_.krylov_iterations += solved.iterations;
  Particles& p = soil_.model.particles;
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    of_.head[a] += of_.change[a];
    p.stress[a] = p.stress[a].plus_isotropic(-unit_weight_ * of_.change[a]);
    progress_.scale = std::max(progress_.scale, std::abs(of_.head[a]));
  }
}

/// Flow and soil in turn until both keep still.
void Consolidation::settle(std::span<const double> known, double tau) {
  const int sweeps = static_cast<int>(std::ceil(waves_between_solves * soil_.extent / soil_.model.spacing));
  const double enough = share_of_split * settings_.tolerance;
  for (int turn = 0; turn < most_turns; ++turn) {
    solve_flow(known, tau);
    relax(sweeps, progress_.time);
    double largest = 0;
    for (const double c : of_.change) largest = std::max(largest, std::abs(c));
    progress_.unbalanced = progress_.scale > 0 ? out_of_balance() : 0;
    if (!std::isfinite(progress_.unbalanced)) break;
    if (turn > 0 && largest <= enough * progress_.scale && progress_.unbalanced <= enough) return;
    if (turn > 0 && progress_.scale == 0 && largest == 0) return;
  }
  throw std::runtime_error(fmt::format(
      "consolidation: the soil does not come to rest at {:.6g} s: it fails, or tolerance is too small",
      progress_.time));
}

/// The loads act at once; no water has left yet.
void Consolidation::start() {
  relax(static_cast<int>(std::ceil(waves_between_solves * soil_.extent / soil_.model.spacing)),
        progress_.time);
  settle(of_.water, 0);
  progress_.started = true;
}

double Consolidation::advance(double now, double until) {
  progress_.time = now;
  take_up_pressure();
  try {
    if (!progress_.started) start();
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
  const double step = left <= progress_.step ? left : std::min(progress_.step, left / 2);  // no tiny last one
  const double tau = gamma_of_sdirk * step;
  const std::size_t n = of_.head.size();
  std::vector<double> known = of_.water, first(n);

  progress_.time = now + tau;
  settle(known, tau);
  drainage_.flow.assemble(of_.head, drainage_.faces, DarcyFlow::Slope::secant, drainage_.slope, of_.inflow);
  first = of_.inflow;
  const auto add_through = [&](double weight) {
    for (const double q : drainage_.flow.through_patches(of_.head, drainage_.faces))
      progress_.drained -= weight * q;
  };
  add_through((1 - gamma_of_sdirk) * step);

  progress_.time = now + step;
  for (std::size_t a = 0; a < n; ++a) known[a] = of_.water[a] + (step - tau) * first[a];
  settle(known, tau);
  drainage_.flow.assemble(of_.head, drainage_.faces, DarcyFlow::Slope::secant, drainage_.slope, of_.inflow);
  add_through(tau);
  for (std::size_t a = 0; a < n; ++a) of_.water[a] = known[a] + tau * of_.inflow[a];
  for (std::size_t a = 0; a < n; ++a)  // what lies on a face that drains gives its water away at once
    if (drainage_.pinned[a] >= 0) {
      const double gained = volume_gained(a) + of_.storage[a] * of_.head[a];
      progress_.drained -= gained - of_.water[a], of_.water[a] = gained;
    }

  for (std::size_t a = 0; a < n; ++a) of_.change[a] = tau * (of_.inflow[a] - first[a]) / of_.split[a];
  const double error = progress_.scale > 0 ? rms(of_.change) / progress_.scale : 0;
  const double wanted = error > 0 ? 0.9 * std::sqrt(settings_.tolerance / error) : settings_.growth;
  const double next = step * std::clamp(wanted, 0.3, settings_.growth);
  progress_.step = step < progress_.step ? std::max(next, std::min(progress_.step, step * wanted)) : next;
  ++counts_.flow_steps;
  return step < left ? now + step : until;
}

void Consolidation::visit(StateArchive& state) {
  state.array("excess_head", of_.head);
  state.array("water_gained", of_.water);
  state.array("accelerations_at_rest", soil_.accelerations);
  state.value("flow_step", progress_.step);
  state.value("largest_head", progress_.scale);
  state.value("drained", progress_.drained);
  state.value("unbalanced", progress_.unbalanced);
  state.value("loaded", progress_.started);
  state.value("flow_steps", counts_.flow_steps);
  state.value("pressure_solves", counts_.pressure_solves);
  state.value("krylov_iterations", counts_.krylov_iterations);
  state.value("soil_sweeps", counts_.soil_sweeps);
  state.value("flow_relaxation_stiffness", soil_.relaxation.stiffness);
  state.value("flow_relaxation_inertia", soil_.relaxation.inertia);
  state.value("flow_relaxation_damping", soil_.relaxation.damping);
}

}  // namespace porosph
