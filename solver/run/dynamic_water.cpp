#include "solver/run/dynamic_water.hpp"

#include <algorithm>
#include <cmath>

#include "solver/space/parallel.hpp"
#include "solver/sph/consistent/flowing_soil.hpp"

namespace porosph {
namespace {

constexpr double krylov_tolerance = 1e-2, in_later_turns = 0.1;  // of the right side
constexpr double turn_tolerance = 0.1;  // of the right side; the next step makes good what is left
constexpr double most_left = 1e-4;      // of a particle's volume
constexpr int most_iterations = 20000, most_turns = 200;

double dot(const std::vector<double>& x, const std::vector<double>& y) {
  return deterministic_sum(x.size(), [&](std::size_t a) { return x[a] * y[a]; });
}

}  // namespace

DynamicWater::DynamicWater(const Case& scene, Model& model, Dynamics& dynamics)
    : model_(model), dynamics_(dynamics), unit_weight_(scene.water.unit_weight), stencils_(scene, model) {
  const std::size_t n = model.particles.size();
  of_.storage = storage_of_water(scene, model.particles);
  for (auto* v : {&of_.gained, &of_.head, &of_.excess, &of_.water, &of_.held, &of_.change, &surface_.open,
                  &surface_.outlet, &work_.rate, &work_.inflow, &work_.right_side, &work_.pressure,
                  &work_.spread, &work_.search.direction, &work_.search.answer, &work_.search.preconditioned})
    v->assign(n, 0);
  for (auto* v : {&work_.velocity, &work_.push, &work_.present, &work_.change}) v->assign(n, Vec2::Zero());
  for (auto* v : {&work_.rates, &work_.search.rates}) v->assign(n, Mat2::Zero());
}

/// Z counts from here.
void DynamicWater::go_on_from(const Consolidation& rested) {
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    of_.head[a] = rested.head()[a];
    of_.excess[a] = -unit_weight_ * of_.head[a];
    of_.gained[a] = rested.volume_gained(a);
    of_.water[a] = rested.water_gained(a) - rested.held_by_stabilisation(a);
  }
  drained_ = rested.drained();
}

void DynamicWater::prepare() {
  const std::int64_t refreshes = dynamics_.counts.refreshes;
  dynamics_.prepare();
  const bool renewed = dynamics_.counts.refreshes != refreshes;
  if (renewed && refreshes > 0) {
    stencils_.renew(model_.particles);
    hold_by_new_stencils();
    ++counts_.renewals;
  }
  if (renewed || !surface_.is_known) measure_surface();
}

/// Z is that of the head with the new stencils.
void DynamicWater::hold_by_new_stencils() {
  stencils_.inertia().apply(of_.head, work_.spread);
  for (std::size_t a = 0; a < of_.held.size(); ++a) {
    const double held = step_.dt * step_.gain * work_.spread[a];
    of_.water[a] += held - of_.held[a], of_.held[a] = held;
  }
}

/// The force of a uniform pressure is the soil's free surface; what that force does to the volumes is what
/// the compact Laplacian, which sees mirror images all around, lacks there.
void DynamicWater::measure_surface() {
  const Particles& p = model_.particles;
  std::ranges::fill(work_.pressure, -unit_weight_);
  dynamics_.excess_accelerations(work_.pressure, work_.push);
  dynamics_.sliding_rates(work_.push, work_.rates);
  dynamics_.volume_rates(work_.rates, work_.rate);
  for (std::size_t a = 0; a < p.size(); ++a) {
    surface_.open[a] = std::max(0.0, p.volume(a) * work_.rate[a]);
    surface_.outlet[a] = stencils_.outlet(a);
  }
  surface_.is_known = true;
  find_fixed();
}

/// Particles that keep their head, 0: on a draining face, or off the body.
void DynamicWater::find_fixed() {
  const FlowingSoil* flow = dynamics_.flow();
  const std::size_t n = of_.head.size();
  surface_.fixed.assign(n, 0);
  for (std::size_t a = 0; a < n; ++a) {
    const bool loose = flow != nullptr && flow->loose().soil_has_flowed() && flow->loose().is(a);
    if (!loose && !stencils_.is_pinned(a) && !stencils_.lies_on_free_surface(a)) continue;
    surface_.fixed[a] = 1;
    of_.head[a] = of_.excess[a] = of_.change[a] = 0;
  }
  let_through();
  work_.matrix.of = {};
}

/// Water goes in and out with the soil where the head is fixed.
void DynamicWater::let_through() {
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    if (!surface_.fixed[a]) continue;
    const double gained = held_water(a) - of_.water[a];
    of_.water[a] += gained, drained_ -= gained;
  }
}

void DynamicWater::add_force(std::span<Vec2> accelerations) {
  dynamics_.excess_accelerations(of_.excess, work_.present);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < accelerations.size(); ++a) accelerations[a] += work_.present[a];
}

/// As the soil's law is strained: at the middle of the step.
std::span<const double> DynamicWater::take_strain(double dt, bool as_foreseen) {
  const Particles& p = model_.particles;
  if (!as_foreseen) dynamics_.sliding_rates(p.velocity, work_.rates);
  dynamics_.volume_rates(work_.rates, work_.rate, dt / 2);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) of_.gained[a] += dt * p.volume(a) * work_.rate[a];
  let_through();
  return work_.rate;
}

/// What the matrix is in a lattice.
void DynamicWater::make_matrix() {
  if (work_.matrix.of == step_) return;
  work_.matrix.of = step_;
  const auto& [dt, gain] = step_;
  const SparseRows& compact = stencils_.inertia().compact();
  const SparseRows* slope = stencils_.drains() ? &stencils_.slope() : nullptr;
  const auto& fixed = surface_.fixed;
  SparseRows& m = work_.matrix.rows = compact;
  for (std::size_t a = 0; a < m.size(); ++a) {
    m.diagonal[a] = of_.storage[a] + dt * gain * (compact.diagonal[a] + surface_.open[a]) +
                    (slope ? dt * (slope->diagonal[a] + surface_.outlet[a]) : 0);
    for (auto k = m.begin[a]; k < m.begin[a + 1]; ++k)
      m.value[k] = fixed[a] || fixed[m.column[k]]
                       ? 0
                       : dt * gain * compact.value[k] + (slope ? dt * slope->value[k] : 0);
  }
}

/// R(h) at the present head; returns what flows into particles whose head is fixed, and what flows out at the
/// free surface [m2/s].
double DynamicWater::find_inflow() {
  if (!stencils_.drains()) return 0;
  stencils_.slope().multiply(of_.head, work_.inflow);
  double lost = 0;
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    const double out = surface_.outlet[a] * of_.head[a];
    work_.inflow[a] = stencils_.still_inflow()[a] - work_.inflow[a] - out;
    lost += out;
    if (!surface_.fixed[a]) continue;
    if (!stencils_.is_pinned(a)) lost += work_.inflow[a];
    work_.inflow[a] = 0;
  }
  return lost;
}

void DynamicWater::make_right_side(Kick kick, std::span<const Vec2> accelerations) {
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
  const double dt = step_.dt;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) work_.velocity[a] = kick(p.velocity[a], accelerations[a]);
  dynamics_.sliding_rates(work_.velocity, work_.rates);
  dynamics_.volume_rates(work_.rates, work_.rate, dt / 2);
  find_inflow();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a)
    work_.right_side[a] = surface_.fixed[a] ? 0
                                            : of_.water[a] - held_water(a) +
                                                  dt * (work_.inflow[a] - p.volume(a) * work_.rate[a]);
}

/// The matrix times a head; and what that head's pressure accelerates, which what holds the soil, P, takes
/// its part of: P / rho is symmetric, and so is D P 1/rho D^T.
void DynamicWater::answer(std::span<const double> head, const Hold& hold) {
  const Particles& p = model_.particles;
  const std::size_t n = head.size();
  const double dt = step_.dt, gain = step_.gain;  // clang 14 takes no structured binding into a parallel loop
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) work_.pressure[a] = -unit_weight_ * head[a];
  dynamics_.excess_accelerations(work_.pressure, work_.push);
  work_.held_push = work_.push;
  if (hold) hold(work_.held_push);
  dynamics_.sliding_rates(work_.held_push, work_.search.rates);
  dynamics_.volume_rates(work_.search.rates, work_.rate);
  stencils_.inertia().apply(head, work_.spread);
  std::ranges::fill(work_.inflow, 0.0);
  if (stencils_.drains()) stencils_.slope().multiply(head, work_.inflow);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a)
    work_.search.answer[a] =
        surface_.fixed[a] ? 0
                          : of_.storage[a] * head[a] + dt * (work_.inflow[a] + surface_.outlet[a] * head[a]) +
                                dt * gain * (work_.spread[a] + p.volume(a) * work_.rate[a]);
}

std::size_t DynamicWater::worst() const {
  std::size_t worst = 0;
  double most = -1;
  for (std::size_t a = 0; a < of_.head.size(); ++a)
    if (const double left = std::abs(work_.right_side[a]) / model_.particles.volume(a); !(left <= most))
      worst = a, most = left;
  return worst;
}

/// Where no part of it is larger than a share of what was there at first, and of the particle's volume.
bool DynamicWater::is_enough(double start) const {
  const std::size_t a = worst();
  return std::abs(work_.right_side[a]) <= most_left * model_.particles.volume(a) &&
         dot(work_.right_side, work_.right_side) <= turn_tolerance * turn_tolerance * start;
}

/// From the present one as a guess.
void DynamicWater::precondition(double tolerance) {
  const KrylovResult solved =
      conjugate_gradients(work_.matrix.rows, work_.right_side, work_.search.preconditioned, tolerance,
                          most_iterations, ToleranceOf::right_side);
  counts_.krylov_iterations += solved.iterations;
  if (!solved.converged) throw Lost{worst()};
}

/// One turn along a direction that is conjugate to the last, whose square in the matrix was `overlap`;
/// returns that of this one. What is left takes the right side's place; Z and dF/dt go along.
double DynamicWater::turn(double overlap, const Hold& hold) {
  const std::size_t n = of_.change.size();
  const double along_last =
      overlap > 0 ? -dot(work_.search.preconditioned, work_.search.answer) / overlap : 0;
  for (std::size_t a = 0; a < n; ++a)
    work_.search.direction[a] = work_.search.preconditioned[a] + along_last * work_.search.direction[a];
  answer(work_.search.direction, hold);
  overlap = dot(work_.search.direction, work_.search.answer);
  const double far = overlap > 0 ? dot(work_.search.direction, work_.right_side) / overlap : 0;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    of_.change[a] += far * work_.search.direction[a];
    work_.right_side[a] -= far * work_.search.answer[a];
    work_.change[a] += far * work_.push[a];
    work_.velocity[a] += far * step_.gain * work_.held_push[a];
    work_.rates[a] += far * step_.gain * work_.search.rates[a];
    of_.held[a] += far * step_.dt * step_.gain * work_.spread[a];
  }
  ++counts_.turns;
  return overlap;
}

/// For dh, and the accelerations that its pressure gives: flexible conjugate gradients (Notay 2000), since
/// the preconditioner is itself solved to a tolerance.
void DynamicWater::solve(const Hold& hold) {
  const double start = dot(work_.right_side, work_.right_side);
  work_.search.preconditioned = of_.change;
  std::ranges::fill(of_.change, 0.0);
  std::ranges::fill(work_.change, Vec2::Zero());
  if (start == 0) return;
  double overlap = 0;
  for (int turns = 0; turns == 0 || !is_enough(start); ++turns) {
    if (turns == most_turns) throw Lost{worst()};
    precondition(turns == 0 ? krylov_tolerance : in_later_turns);
    overlap = turn(overlap, hold);
    std::ranges::fill(work_.search.preconditioned, 0.0);
  }
}

/// Takes dh in: pressures, and what flows at the end of the step.
void DynamicWater::keep() {
  const std::size_t n = of_.head.size();
  for (std::size_t a = 0; a < n; ++a) {
    of_.head[a] += of_.change[a];
    of_.excess[a] = -unit_weight_ * of_.head[a];
  }
  const double lost = find_inflow() - stencils_.through_faces(of_.head);
  if (stencils_.drains())
    for (std::size_t a = 0; a < n; ++a) of_.water[a] += step_.dt * work_.inflow[a];
  drained_ += step_.dt * lost;
}

/// Of all its pressure, with the mean of the velocities before and after.
void DynamicWater::count_work() {
  const Particles& p = model_.particles;
  taken_ -= deterministic_sum(p.size(), [&](std::size_t a) {
    const Vec2 mean = (p.velocity[a] + work_.velocity[a]) / 2;
    return step_.gain * p.mass[a] * (work_.present[a] + work_.change[a]).dot(mean);
  });
}

void DynamicWater::add_change(Kick kick, double dt, std::span<Vec2> accelerations, const Hold& hold) {
  step_ = {dt, kick.gain};
  if (stencils_.follow_pores(of_.gained)) work_.matrix.of = {};
  make_matrix();
  make_right_side(kick, accelerations);
  solve(hold);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < accelerations.size(); ++a) accelerations[a] += work_.change[a];
  count_work();
  keep();
  ++counts_.steps;
}

double DynamicWater::imbalance() const {
  double missing = -drained_;
  for (const double w : of_.water) missing -= w;
  return missing;
}

double DynamicWater::misfit() const {
  double largest = 0;
  for (std::size_t a = 0; a < of_.head.size(); ++a)
    largest = std::max(largest, std::abs(of_.water[a] - held_water(a)) / model_.particles.volume(a));
  return largest;
}

double DynamicWater::energy() const {
  return deterministic_sum(of_.head.size(), [&](std::size_t a) {
    return unit_weight_ * of_.head[a] * (of_.storage[a] * of_.head[a] + of_.held[a]) / 2;
  });
}

double DynamicWater::shown_energy() const {
  return -deterministic_sum(of_.head.size(),
                            [&](std::size_t a) { return model_.particles.volume(a) * of_.excess[a]; });
}

void DynamicWater::visit(StateArchive& state) {
  for (auto* v : {&of_.gained, &of_.head, &of_.excess, &of_.water, &of_.held, &of_.change, &surface_.open,
                  &surface_.outlet})
    state.array("dynamic_water", *v);
  surface_.fixed.resize(of_.head.size());
  state.array("dynamic_fixed", surface_.fixed);
  state.value("dynamic_surface_is_known", surface_.is_known);
  for (double* v : {&step_.dt, &step_.gain, &drained_, &taken_}) state.value("dynamic_total", *v);
  for (std::int64_t* count : {&counts_.steps, &counts_.krylov_iterations, &counts_.renewals, &counts_.turns})
    state.value("dynamic_count", *count);
  work_.matrix.of = {};
  stencils_.visit(state, model_.particles);
}

}  // namespace porosph
