#include "solver/water/flow/richards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

constexpr double gamma_of_sdirk = 1 - 1 / std::numbers::sqrt2;
constexpr double balanced = 1e-9;         // of the pores: what a stage may leave
constexpr double nearly_balanced = 1e-7;  // the same where Newton's method gets no further
constexpr double krylov_tolerance = 1e-4;
constexpr int most_newton = 50, most_secants = 8, most_flips = 3, most_halvings = 8;
constexpr int tries_of_mean = 4;  // of a step, before kr of where water comes from is taken
constexpr double first_dry = 0.95, first_wet = 0.05, kept_share = 0.3;  // of saturation, in a Newton step
constexpr double most_error = 4;  // over the tolerance, of a step that is kept

/// psi after a change that Newton's method asks for. Curves that are flat where the soil is full and where it
/// is dry would lead too far from there: a change takes no more than a part of what a particle has, and in
/// dry soil no more than what fills it.
double changed(const Retention& soil, double psi, double change) {
  const Retention::Stored s = soil.stored(psi);
  const double asked = psi + change;
  if (change < 0) {
    if (asked >= 0 || !soil.is_curved()) return asked;
    const double least = psi >= 0 ? first_dry : s.saturation * kept_share;
    return least > 0 ? std::max(asked, soil.pressure_head(least)) : asked;
  }
  if (psi >= 0) return asked;
  if (!(s.slope > 0)) return std::min(asked, soil.pressure_head(std::lerp(s.saturation, 1, first_wet)));
  if (asked < 0.5 * psi) return asked;
  const double wanted = s.saturation + s.slope * change;
  return std::min(asked, wanted < 1 ? std::max(psi, soil.pressure_head(wanted)) : 0);
}

}  // namespace

Richards::Richards(DarcyFlow& flow, std::vector<Pores> pores, std::vector<int> face_of_patch,
                   std::size_t faces, Start start, const Settings& settings)
    : flow_(flow),
      pores_(std::move(pores)),
      face_of_patch_(std::move(face_of_patch)),
      settings_(settings),
      of_{std::move(start.head), {}},
      faces_(std::move(start.faces)),
      next_step_(settings.first_step),
      through_faces_(faces, 0) {
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    const double volume = flow.pairs().volume[a];
    pores_[a].free *= volume, pores_[a].elastic *= volume;
    of_.water.push_back(water(a));
  }
  of_.water_at_start = deterministic_sum(of_.head.size(), [&](std::size_t a) { return of_.water[a]; });
  work_.inflow.resize(of_.head.size()), work_.residual.resize(of_.head.size());
  work_.change.resize(of_.head.size()), work_.storing.resize(of_.head.size());
}

double Richards::water(std::size_t a) const {
  return pores_[a].content(flow_.retention(a), of_.head[a] - flow_.height(a)).value;
}

Richards::Balance Richards::balance() const {
  Balance b = sums_;
  b.gained = deterministic_sum(of_.head.size(), [&](std::size_t a) { return water(a); }) - of_.water_at_start;
  return b;
}

/// known + tau R(h) - W(h) and its slope; returns its root mean square over the pores [-].
double Richards::assemble(std::span<const double> known, double tau, DarcyFlow::Slope kind) {
  flow_.assemble(of_.head, faces_, kind, work_.slope, work_.inflow);
  work_.pinned = flow_.pinning_patches(faces_);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < of_.head.size(); ++a) {
    const WaterContent w = pores_[a].content(flow_.retention(a), of_.head[a] - flow_.height(a));
    const bool free = work_.pinned[a] < 0;
    work_.storing[a] = (w.value - known[a]) / tau;
    work_.residual[a] = free ? known[a] + tau * work_.inflow[a] - w.value : 0;
    work_.slope.diagonal[a] = tau * work_.slope.diagonal[a] + (free ? w.slope : 0);
  }
  for (double& v : work_.slope.value) v *= tau;
  const double squares = deterministic_sum(
      of_.head.size(), [&](std::size_t a) { return std::pow(work_.residual[a] / pores_[a].free, 2); });
  return std::sqrt(squares / static_cast<double>(of_.head.size()));
}

/// The change of heads that what is assembled asks for; false where there is none.
bool Richards::find_change() {
  std::ranges::fill(work_.change, 0.0);
  const int most = static_cast<int>(20 * std::sqrt(static_cast<double>(of_.head.size())) + 1000);
  const KrylovResult solved = bicgstab(work_.slope, work_.residual, work_.change, krylov_tolerance, most);
  ++counts_.newton_steps, counts_.krylov_iterations += solved.iterations;
  return std::isfinite(solved.residual);
}

void Richards::change_heads(std::span<const double> before, double share) {
  for (std::size_t a = 0; a < before.size(); ++a) {
    const double y = flow_.height(a);
    of_.head[a] = y + changed(flow_.retention(a), before[a] - y, share * work_.change[a]);
  }
}

/// One step of Newton's method, as long as it lessens what is left. Returns false, and leaves the heads as
/// they were, where it does not.
bool Richards::improve(std::span<const double> known, double tau, double& size) {
  if (!find_change()) return false;
  const std::vector<double> before = of_.head;
  double share = 1;
  for (int halvings = 0; halvings < most_halvings; ++halvings, share /= 2) {
    change_heads(before, share);
    const double next = assemble(known, tau, DarcyFlow::Slope::newton);
    if (next < size) return size = next, true;
  }
  of_.head = before;
  assemble(known, tau, DarcyFlow::Slope::newton);
  return false;
}

/// One step with kr as it is (Picard's, of the mixed form), taken whole: out of where Newton's method stops.
bool Richards::step_by_secant(std::span<const double> known, double tau, double& size) {
  assemble(known, tau, DarcyFlow::Slope::secant);
  if (!find_change()) return false;
  change_heads(std::vector<double>(of_.head), 1);
  size = assemble(known, tau, DarcyFlow::Slope::newton);
  return true;
}

bool Richards::solve(std::span<const double> known, double tau, double time) {
  faces_.set_time(time_ = time);
  FaceSwitch faces(flow_, faces_.size(), most_flips);
  flow_.pin(of_.head, faces_);
  double size = assemble(known, tau, DarcyFlow::Slope::newton);
  int secants = 0;
  for (int i = 0; i < most_newton && std::isfinite(size); ++i) {
    if (size > balanced && improve(known, tau, size)) continue;
    if (size > nearly_balanced && secants++ < most_secants && step_by_secant(known, tau, size)) continue;
    if (!faces.update(of_.head, faces_, work_.storing)) return size <= nearly_balanced;
    flow_.pin(of_.head, faces_);
    size = assemble(known, tau, DarcyFlow::Slope::newton);
  }
  return false;
}

/// Fills what flows into particles in the first stage and the mean through the patches. The state is that of
/// the end where it returns true.
bool Richards::try_step(double now, double step, std::vector<double>& first, std::vector<double>& through) {
  const double tau = gamma_of_sdirk * step;
  std::vector<double> known = of_.water;
  if (!solve(known, tau, now + tau)) return false;
  first = work_.inflow;
  through = flow_.through_patches(of_.head, faces_);
  for (double& q : through) q *= 1 - gamma_of_sdirk;
  for (std::size_t a = 0; a < known.size(); ++a) known[a] += (step - tau) * first[a];
  if (!solve(known, tau, now + step)) return false;
  const std::vector<double> last = flow_.through_patches(of_.head, faces_);
  for (std::size_t p = 0; p < last.size(); ++p) through[p] += gamma_of_sdirk * last[p];
  for (std::size_t a = 0; a < known.size(); ++a) {
    if (work_.pinned[a] < 0) {
      work_.storing[a] = known[a] + tau * work_.inflow[a];
    } else {  // its face gives what it takes up
      work_.storing[a] = water(a);
      through[work_.pinned[a]] += (work_.storing[a] - known[a]) / step;
    }
  }
  return true;
}

void Richards::keep(double step, const std::vector<double>& through) {
  of_.water = work_.storing;
  std::ranges::fill(through_faces_, 0.0);
  for (std::size_t p = 0; p < through.size(); ++p) {
    (through[p] > 0 ? sums_.entered : sums_.left) += step * std::abs(through[p]);
    if (face_of_patch_[p] >= 0) through_faces_[face_of_patch_[p]] += through[p];
  }
  ++counts_.steps;
}

double Richards::advance(double now, double until) {
  const std::vector<double> head = of_.head;
  const FaceConditions faces = faces_;
  std::vector<double> first, through;
  double wanted = next_step_;
  for (int tries = 0;; ++tries) {
    const double left = until - now;
    const double step = left <= wanted ? left : std::min(wanted, left / 2);  // no tiny last one
    flow_.set_mean(tries < tries_of_mean ? DarcyFlow::Mean::arithmetic : DarcyFlow::Mean::upstream);
    const bool solved = try_step(now, step, first, through);
    flow_.set_mean(DarcyFlow::Mean::arithmetic);
    const double error = solved ? error_of(step, first) / settings_.tolerance : 0;
    if (solved && (error <= most_error || step <= settings_.least_step)) {
      keep(step, through);
      const double ratio = error > 0 ? 0.9 / std::sqrt(error) : settings_.growth;
      const double next = step * std::clamp(ratio, 0.3, settings_.growth);
      next_step_ = step < wanted ? std::max(next, std::min(wanted, step * ratio)) : next;
      return step < left ? now + step : until;
    }
    if (step <= settings_.least_step) {
      const auto worst = std::ranges::max_element(work_.residual, {}, [](double r) { return std::abs(r); });
      throw NotConverged{
          .particle = static_cast<std::size_t>(worst - work_.residual.begin()), .time = now, .step = step};
    }
    ++counts_.refused;
    wanted = step * (solved ? std::clamp(0.9 / std::sqrt(error), 0.1, 0.5) : 1.0 / 3);
    of_.head = head, faces_ = faces;
  }
}

/// What the embedded step of first order differs by, in saturation (root mean square) [-].
double Richards::error_of(double step, std::span<const double> first) const {
  const double tau = gamma_of_sdirk * step;
  const double squares = deterministic_sum(of_.head.size(), [&](std::size_t a) {
    return work_.pinned[a] < 0 ? std::pow(tau * (work_.inflow[a] - first[a]) / pores_[a].free, 2) : 0;
  });
  return std::sqrt(squares / static_cast<double>(of_.head.size()));
}

void Richards::visit(StateArchive& state) {
  state.array("flow_head", of_.head);
  state.array("flow_water", of_.water);
  std::vector<std::int32_t> states;
  for (const PatchState s : faces_.states()) states.push_back(static_cast<std::int32_t>(s));
  state.array("flow_patches", states);
  for (std::size_t p = 0; p < states.size(); ++p)
    faces_.set_state(static_cast<std::int32_t>(p), static_cast<PatchState>(states[p]));
  state.array("flow_through_faces", through_faces_);
  state.value("flow_time", time_);
  if (state.restoring()) faces_.set_time(time_);
  state.value("flow_start_water", of_.water_at_start);
  state.value("flow_next_step", next_step_);
  state.value("flow_entered", sums_.entered);
  state.value("flow_left", sums_.left);
  state.value("flow_steps_done", counts_.steps);
  state.value("flow_steps_refused", counts_.refused);
  state.value("flow_newton_steps", counts_.newton_steps);
  state.value("flow_krylov_iterations", counts_.krylov_iterations);
}

}  // namespace porosph
