#include "solver/run/dynamic_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/space/parallel.hpp"
#include "solver/sph/consistent/flowing_soil.hpp"

namespace porosph {
namespace {

constexpr double krylov_tolerance = 1e-2;  // of the right side; the next step makes good what is left
constexpr int most_iterations = 20000;
constexpr double share_of_free_side = 0.5;  // of a cell: the particle lies at a free surface

/// What mirrors soil that has left its outline: closed stretches.
HydraulicOutline outline_of_walls(const std::vector<Wall>& walls) {
  HydraulicOutline outline;
  outline.stretches = walls;
  outline.first = {0};
  for (std::size_t i = 0; i < walls.size(); ++i) {
    outline.patches.push_back(
        {.stretch = static_cast<int>(i), .from = 0, .to = (walls[i].to - walls[i].from).norm(), .face = 0});
    outline.first.push_back(static_cast<std::int32_t>(i + 1));
  }
  return outline;
}

DarcyFlow flow_of_moved(std::vector<SoilCase> soils, const HydraulicOutline& walls, const Particles& p,
                        double spacing) {
  const std::vector<double> below(p.size(), -1e9);
  const std::vector<Retention> full(soils.size());
  return {make_flow_pairs_of_moved(soils, walls, p, spacing), walls, full, p.soil, below};
}

}  // namespace

DynamicWater::DynamicWater(const Case& scene, Model& model, Dynamics& dynamics)
    : scene_(scene), model_(model), dynamics_(dynamics), unit_weight_(scene.water.unit_weight) {
  const Particles& p = model.particles;
  const std::size_t n = p.size();
  for (const SoilCase& soil : scene.soils)
    inertia_.push_back(unit_weight_ * scene.loading.gravity / soil.unit_weight_saturated);
  of_.storage = storage_of_water(scene, p);
  for (std::size_t a = 0; a < n; ++a) of_.start_volume.push_back(p.volume(a));
  for (auto* v : {&of_.head, &of_.excess, &of_.water, &of_.held, &of_.change, &of_.open}) v->assign(n, 0);
  for (auto* v : {&work_.rate, &work_.inflow, &work_.right_side, &work_.pressure, &work_.spread})
    v->resize(n);
  work_.velocity.resize(n), work_.push.resize(n);
  stencils_.drainage = drainage(scene, p);
  stencils_.inertia = pressure_stabilisation(scene.soils, inertia_, p, model.spacing);
  take_stencils();
  if (scene.water.is_dynamic()) take_over();
}

void DynamicWater::begin_drained() {
  drained_soil_ = true;
  for (std::size_t a = 0; a < of_.head.size(); ++a) of_.start_volume[a] = model_.particles.volume(a);
  if (dynamics_.counts.refreshes > 1) renew();
  take_over();
}

/// Soil that has yielded may get another density when the reference is rebuilt. That is not a change of
/// volume.
void DynamicWater::prepare() {
  const std::int64_t refreshes = dynamics_.counts.refreshes;
  const std::vector<double> density = model_.particles.density;
  dynamics_.prepare();
  const bool renewed = dynamics_.counts.refreshes != refreshes;
  if (renewed) {
    const Particles& p = model_.particles;
    for (std::size_t a = 0; a < p.size(); ++a) of_.start_volume[a] += p.volume(a) - p.mass[a] / density[a];
    if (refreshes > 0) renew();
  }
  if (renewed || !surface_is_known_) measure_surface();
}

void DynamicWater::renew() {
  made_at_ = model_.particles.position;
  density_then_ = model_.particles.density;
  make_stencils(model_.particles);
  ++counts_.renewals;
}

void DynamicWater::make_stencils(const Particles& p) {
  const HydraulicOutline walls = outline_of_walls(model_.walls);
  if (stencils_.drainage)
    stencils_.drainage = Drainage{.outline = walls,
                                  .faces = FaceConditions(walls, {{.kind = FaceKind::closed}}, true),
                                  .flow = flow_of_moved(scene_.soils, walls, p, model_.spacing),
                                  .pinned = std::vector<std::int32_t>(p.size(), -1)};
  std::vector<SoilCase> soils = scene_.soils;
  for (std::size_t i = 0; i < soils.size(); ++i) soils[i].permeability = Point::Constant(inertia_[i]);
  stencils_.inertia = {flow_of_moved(soils, walls, p, model_.spacing), walls, p.position};
  take_stencils();
}

/// Saturated flow is linear: its rates at h = 0 and its slope are all of it.
void DynamicWater::take_stencils() {
  const std::size_t n = of_.head.size();
  work_.of_dt = 0;
  stencils_.still_inflow.assign(n, 0);
  if (!stencils_.drainage) return;
  const std::vector<double> zero(n, 0);
  stencils_.drainage->flow.assemble(zero, stencils_.drainage->faces, DarcyFlow::Slope::secant, stencils_.flow,
                                    stencils_.still_inflow);
}

/// The force of a uniform pressure is the soil's free surface; what that force does to the volumes is what
/// the compact Laplacian, which sees mirror images all around, lacks there.
void DynamicWater::measure_surface() {
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
  std::ranges::fill(work_.pressure, -unit_weight_);
  dynamics_.excess_accelerations(work_.pressure, work_.push);
  dynamics_.volume_rates(work_.push, work_.rate);
  for (std::size_t a = 0; a < n; ++a) of_.open[a] = std::max(0.0, p.volume(a) * work_.rate[a]);
  lies_free_.assign(n, 0);
  for (std::size_t a = 0; a < n && !made_at_.empty(); ++a) {
    const double area = p.mass[a] * work_.push[a].norm() / unit_weight_;
    lies_free_[a] = area > share_of_free_side * std::sqrt(p.volume(a) / p.fill[a]) ? 1 : 0;
  }
  surface_is_known_ = true;
  find_fixed();
}

/// Particles that keep their head, 0: on a draining face, off the body, or at the
/// free surface of soil that has moved.
void DynamicWater::find_fixed() {
  const FlowingSoil* flow = dynamics_.flow();
  const std::size_t n = of_.head.size();
  fixed_.assign(n, 0);
  for (std::size_t a = 0; a < n; ++a) {
    const bool drains = stencils_.drainage && stencils_.drainage->pinned[a] >= 0;
    const bool loose = flow != nullptr && flow->loose().soil_has_flowed() && flow->loose().is(a);
    fixed_[a] = drained_soil_ || drains || loose || lies_free_[a] != 0 ? 1 : 0;
    if (fixed_[a]) of_.head[a] = of_.excess[a] = of_.change[a] = 0;
  }
  work_.of_dt = 0;
}

void DynamicWater::make_matrix(double dt, double gain) {
  if (work_.of_dt == dt && work_.of_gain == gain) return;
  work_.of_dt = dt, work_.of_gain = gain;
  const SparseRows& compact = stencils_.inertia.compact();
  const bool drains = stencils_.drainage.has_value();
  SparseRows& m = work_.matrix = compact;
  for (std::size_t a = 0; a < m.size(); ++a) {
    const bool fixed = fixed_[a] != 0;
    m.diagonal[a] = of_.storage[a] + dt * gain * (compact.diagonal[a] + of_.open[a]) +
                    (drains ? dt * stencils_.flow.diagonal[a] : 0);
    for (auto k = m.begin[a]; k < m.begin[a + 1]; ++k)
      m.value[k] = fixed || fixed_[m.column[k]]
                       ? 0
                       : dt * gain * compact.value[k] + (drains ? dt * stencils_.flow.value[k] : 0);
  }
}

/// R(h) at the present head; returns what flows into particles whose head is fixed [m2/s].
double DynamicWater::find_inflow() {
  if (!stencils_.drainage) return 0;
  stencils_.flow.multiply(of_.head, work_.inflow);
  double into_fixed = 0;
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    work_.inflow[a] = stencils_.still_inflow[a] - work_.inflow[a];
    if (fixed_[a] == 0) continue;
    if (stencils_.drainage->pinned[a] < 0) into_fixed += work_.inflow[a];
    work_.inflow[a] = 0;
  }
  return into_fixed;
}

double DynamicWater::held_water(std::size_t a) const {
  return model_.particles.volume(a) - of_.start_volume[a] + of_.storage[a] * of_.head[a] + of_.held[a];
}

void DynamicWater::make_right_side(Kick kick, double dt, std::span<const Vec2> accelerations) {
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) work_.velocity[a] = kick(p.velocity[a], accelerations[a]);
  dynamics_.volume_rates(work_.velocity, work_.rate);
  find_inflow();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a)
    work_.right_side[a] =
        fixed_[a] ? 0 : of_.water[a] - held_water(a) + dt * (work_.inflow[a] - p.volume(a) * work_.rate[a]);
}

void DynamicWater::solve() {
  const KrylovResult solved = conjugate_gradients(work_.matrix, work_.right_side, of_.change,
                                                  krylov_tolerance, most_iterations, ToleranceOf::right_side);
  counts_.krylov_iterations += solved.iterations;
  if (!solved.converged)
    throw std::runtime_error(
        fmt::format("pore pressure in motion: the equations do not converge ({:.1e} left)", solved.residual));
}

/// Takes dh in: pressures, what stabilisation holds, and what flows at the end of the step.
void DynamicWater::keep(double dt, double gain) {
  stencils_.inertia.apply(of_.change, work_.spread);
  const Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    of_.head[a] += of_.change[a];
    of_.excess[a] = -unit_weight_ * of_.head[a];
    of_.held[a] += dt * gain * work_.spread[a];
  }
  double left = find_inflow();
  for (std::size_t a = 0; a < p.size(); ++a) of_.water[a] += dt * work_.inflow[a];
  if (stencils_.drainage)
    for (const double q : stencils_.drainage->flow.through_patches(of_.head, stencils_.drainage->faces))
      left -= q;
  drained_ += dt * left;
}

/// Water goes in and out with the soil where the head is fixed.
void DynamicWater::let_through() {
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    if (!fixed_[a]) continue;
    const double gained = held_water(a) - of_.water[a];
    of_.water[a] += gained, drained_ -= gained;
  }
}

/// What one step leaves the next makes good: where it does not, the pressure is of no soil.
void DynamicWater::check_volumes() const {
  constexpr double most = 1e-3;
  for (std::size_t a = 0; a < of_.head.size(); ++a)
    if (!fixed_[a] && !(std::abs(of_.water[a] - held_water(a)) < most * model_.particles.volume(a)))
      throw Lost{a};
}

void DynamicWater::add_change(Kick kick, double dt, std::span<Vec2> accelerations) {
  let_through();
  check_volumes();
  make_matrix(dt, kick.gain);
  make_right_side(kick, dt, accelerations);
  solve();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < of_.change.size(); ++a) work_.pressure[a] = -unit_weight_ * of_.change[a];
  dynamics_.excess_accelerations(work_.pressure, work_.push);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < accelerations.size(); ++a) accelerations[a] += work_.push[a];
  keep(dt, kick.gain);
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
    if (!fixed_[a])
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
  const std::size_t n = of_.head.size();
  for (auto* v : {&of_.start_volume, &of_.head, &of_.excess, &of_.water, &of_.held, &of_.change, &of_.open})
    state.array("dynamic_water", *v);
  state.value("dynamic_drained", drained_);
  state.value("dynamic_surface_is_known", surface_is_known_);
  state.value("dynamic_steps", counts_.steps);
  state.value("dynamic_iterations", counts_.krylov_iterations);
  state.value("dynamic_renewals", counts_.renewals);
  state.value("dynamic_drained_soil", drained_soil_);
  fixed_.resize(n);
  state.array("dynamic_fixed", fixed_);
  bool moved = !made_at_.empty();
  state.value("dynamic_moved", moved);
  work_.of_dt = 0;
  if (!moved) return;
  made_at_.resize(n), density_then_.resize(n);
  state.array("dynamic_position", made_at_);
  state.array("dynamic_density", density_then_);
  if (!state.restoring()) return;
  Particles then = model_.particles;
  then.position = made_at_, then.density = density_then_;
  make_stencils(then);
}

}  // namespace porosph
