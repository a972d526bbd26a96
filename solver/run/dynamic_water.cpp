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
constexpr double outer_tolerance = 2e-2;
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
  for (auto* v : {&of_.gained, &of_.head, &of_.excess, &of_.water, &of_.held, &of_.change, &of_.open, &of_.outlet})
    v->assign(n, 0);
  for (auto* v : {&work_.rate, &work_.inflow, &work_.right_side, &work_.pressure, &work_.spread})
    v->resize(n);
  work_.velocity.resize(n), work_.push.resize(n);
  stencils_.drainage = drainage(scene, p);
  stencils_.inertia = pressure_stabilisation(scene.soils, inertia_, p, model.spacing);
  take_stencils();
}

void DynamicWater::begin_drained() {
  drained_soil_ = true;
  if (dynamics_.counts.refreshes > 1) renew();
}

void DynamicWater::prepare() {
  const std::int64_t refreshes = dynamics_.counts.refreshes;
  dynamics_.prepare();
  const bool renewed = dynamics_.counts.refreshes != refreshes;
  if (renewed && refreshes > 0) renew();
  if (renewed || !surface_is_known_) measure_surface();
}

void DynamicWater::add_force(std::span<Vec2> accelerations) {
  dynamics_.excess_accelerations(of_.excess, work_.push);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < accelerations.size(); ++a) accelerations[a] += work_.push[a];
}

std::span<const double> DynamicWater::take_strain(double dt) {
  const Particles& p = model_.particles;
  dynamics_.volume_rates(p.velocity, work_.rate, dt / 2);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < of_.gained.size(); ++a) of_.gained[a] += dt * p.volume(a) * work_.rate[a];
  let_through();
  return work_.rate;
}

void DynamicWater::renew() {
  made_at_ = model_.particles.position;
  density_then_ = model_.particles.density;
  make_stencils(model_.particles);
  stencils_.inertia.apply(of_.head, work_.spread);
  const double of_step = work_.of_last_dt * work_.of_last_gain;
  for (std::size_t a = 0; a < of_.held.size(); ++a) {
    const double held = of_step * work_.spread[a];
    of_.water[a] += held - of_.held[a], of_.held[a] = held;
  }
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
  for (std::size_t a = 0; a < n && !made_at_.empty(); ++a) {
    const Vec2 area = p.mass[a] / unit_weight_ * work_.push[a];
    const Point& k = scene_.soils[p.soil[a]].permeability;
    const double length = area.norm(), half = std::sqrt(p.volume(a) / p.fill[a]) / 2;
    of_.outlet[a] = stencils_.drainage && length > 0
                        ? (k.x() * area.x() * area.x() + k.y() * area.y() * area.y()) / (length * half)
                        : 0;
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
    fixed_[a] = drained_soil_ || drains || loose ? 1 : 0;
    if (fixed_[a]) of_.head[a] = of_.excess[a] = of_.change[a] = 0;
  }
  work_.of_dt = 0;
}

void DynamicWater::make_matrix(double dt, double gain) {
  if (work_.of_dt == dt && work_.of_gain == gain) return;
  work_.of_dt = dt, work_.of_gain = gain;
  work_.of_last_dt = dt, work_.of_last_gain = gain;
  const SparseRows& compact = stencils_.inertia.compact();
  const bool drains = stencils_.drainage.has_value();
  SparseRows& m = work_.matrix = compact;
  for (std::size_t a = 0; a < m.size(); ++a) {
    const bool fixed = fixed_[a] != 0;
    m.diagonal[a] = of_.storage[a] + dt * gain * (compact.diagonal[a] + of_.open[a]) +
                    (drains ? dt * (stencils_.flow.diagonal[a] + of_.outlet[a]) : 0);
    for (auto k = m.begin[a]; k < m.begin[a + 1]; ++k)
      m.value[k] = fixed || fixed_[m.column[k]]
                       ? 0
                       : dt * gain * compact.value[k] + (drains ? dt * stencils_.flow.value[k] : 0);
  }
}

/// R(h) at the present head; returns what flows into particles whose head is fixed, less what flows out at
/// the free surface [m2/s].
double DynamicWater::find_inflow() {
  if (!stencils_.drainage) return 0;
  stencils_.flow.multiply(of_.head, work_.inflow);
  double lost = 0;
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    const double out = of_.outlet[a] * of_.head[a];
    work_.inflow[a] = stencils_.still_inflow[a] - work_.inflow[a] - out;
    lost += out;
    if (fixed_[a] == 0) continue;
    if (stencils_.drainage->pinned[a] < 0) lost += work_.inflow[a];
    work_.inflow[a] = 0;
  }
  return lost;
}

double DynamicWater::held_water(std::size_t a) const {
  return of_.gained[a] + of_.storage[a] * of_.head[a] + of_.held[a];
}

void DynamicWater::make_right_side(Kick kick, double dt, std::span<const Vec2> accelerations) {
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) work_.velocity[a] = kick(p.velocity[a], accelerations[a]);
  dynamics_.volume_rates(work_.velocity, work_.rate, dt / 2);
  find_inflow();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a)
    work_.right_side[a] =
        fixed_[a] ? 0 : of_.water[a] - held_water(a) + dt * (work_.inflow[a] - p.volume(a) * work_.rate[a]);
}

/// A x, and the accelerations that the pressure of x gives.
void DynamicWater::answer(std::span<const double> x, double dt, double gain, std::vector<double>& out) {
  const Particles& p = model_.particles;
  const std::size_t n = x.size();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) work_.pressure[a] = -unit_weight_ * x[a];
  dynamics_.excess_accelerations(work_.pressure, work_.push);
  dynamics_.volume_rates(work_.push, work_.rate);
  stencils_.inertia.apply(x, work_.spread);
  if (stencils_.drainage) stencils_.flow.multiply(x, work_.inflow);
  for (std::size_t a = 0; a < n; ++a) {
    const double out_of = stencils_.drainage ? work_.inflow[a] + of_.outlet[a] * x[a] : 0;
    out[a] = fixed_[a] ? 0
                       : of_.storage[a] * x[a] + dt * out_of +
                             dt * gain * (work_.spread[a] + p.volume(a) * work_.rate[a]);
  }
}

void DynamicWater::solve(double dt, double gain) {
  const std::size_t n = of_.change.size();
  const auto dot = [&](const std::vector<double>& x, const std::vector<double>& y) {
    return deterministic_sum(n, [&](std::size_t a) { return x[a] * y[a]; });
  };
  std::vector<double>& r = work_.right_side;
  std::vector<double> z = of_.change, direction(n), image(n), x(n);
  work_.total_push.assign(n, Vec2::Zero());
  const double enough = outer_tolerance * outer_tolerance * dot(r, r);
  if (dot(r, r) == 0) { of_.change.assign(n, 0); return; }
  double before = 1;
  for (int k = 0;; ++k) {
    const KrylovResult solved =
        conjugate_gradients(work_.matrix, r, z, k == 0 ? krylov_tolerance : 0.1, most_iterations, ToleranceOf::right_side);
    counts_.krylov_iterations += solved.iterations;
    if (!solved.converged)
      throw std::runtime_error(
          fmt::format("pore pressure in motion: the equations do not converge ({:.1e} left)", solved.residual));
    const double beta = k == 0 ? 0 : -dot(z, image) / before;
    for (std::size_t a = 0; a < n; ++a) direction[a] = z[a] + beta * direction[a];
    answer(direction, dt, gain, image);
    before = dot(direction, image);
    const double alpha = dot(direction, r) / before;
    for (std::size_t a = 0; a < n; ++a) {
      x[a] += alpha * direction[a], r[a] -= alpha * image[a];
      work_.total_push[a] += alpha * work_.push[a];
      z[a] = 0;
    }
    ++counts_.solves;
    static const bool verbose = getenv("PW_VERBOSE") != nullptr;
    if (verbose) fmt::print("{} {} it {} alpha {:.4f} left {:.2e} of {:.2e}\n", counts_.steps, k, solved.iterations, alpha, std::sqrt(dot(r, r)), std::sqrt(enough) / outer_tolerance);
    double worst = 0;
    for (std::size_t a = 0; a < n; ++a) worst = std::max(worst, std::abs(r[a]) / model_.particles.volume(a));
    if ((dot(r, r) <= enough && worst <= 1e-5) || k == 100) break;
  }
  of_.change = x;
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
  if (getenv("PW_VERBOSE")) {
    std::size_t worst = 0, wb = 0; double most = 0; int count = 0;
    for (std::size_t a = 0; a < of_.head.size(); ++a) {
      const double m = fixed_[a] ? 0 : std::abs(of_.water[a] - held_water(a)) / model_.particles.volume(a);
      if (m > 1e-4) ++count;
      if (m > most) most = m, worst = a;
    }
    const Particles& p = model_.particles;
    fmt::print("step {} misfit {:.2e} at ({:.3f} {:.3f}) start ({:.2f} {:.2f}) v ({:.3f} {:.3f}) h {:.2f} vol {:.4f} n>1e-4 {} refr {} nonsense {}\n", counts_.steps, most, p.position[worst].x(), p.position[worst].y(), p.start[worst].x(), p.start[worst].y(), p.velocity[worst].x(), p.velocity[worst].y(), of_.head[worst], p.volume(worst), count, dynamics_.counts.refreshes, wb);
  }
  check_volumes();
  make_matrix(dt, kick.gain);
  make_right_side(kick, dt, accelerations);
  solve(dt, kick.gain);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < accelerations.size(); ++a) accelerations[a] += work_.total_push[a];
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
  for (auto* v : {&of_.gained, &of_.head, &of_.excess, &of_.water, &of_.held, &of_.change, &of_.open, &of_.outlet})
    state.array("dynamic_water", *v);
  state.value("dynamic_drained", drained_);
  state.value("dynamic_last_step", work_.of_last_dt);
  state.value("dynamic_last_gain", work_.of_last_gain);
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
