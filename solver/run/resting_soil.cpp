#include "solver/run/resting_soil.hpp"

#include <algorithm>
#include <cmath>

#include "solver/run/relaxed_step.hpp"
#include "solver/space/parallel.hpp"

namespace porosph {

RestingSoil::RestingSoil(Model& model, Dynamics& dynamics, SurfaceForces& surface, double dt)
    : model_(model), dynamics_(dynamics), surface_(surface), dt_(dt), excess_(model.particles.size(), 0) {
  const Particles& p = model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) start_volume_.push_back(p.volume(a));
  accelerations_.resize(p.size());
  extent_ = extent_of(p);
  dynamics.carry_excess(excess_);
}

int RestingSoil::crossing() const {
  constexpr double margin = 1.2;
  const double crossing = std::max(margin * extent_ / model_.spacing, extent_ / (model_.wave_speed * dt_));
  return static_cast<int>(std::ceil(crossing));
}

/// Soil that has yielded may get another density when the reference is rebuilt. That is not a change of
/// volume.
void RestingSoil::prepare() {
  const std::int64_t refreshes = dynamics_.counts.refreshes;
  const std::vector<double> density = model_.particles.density;
  dynamics_.prepare();
  if (dynamics_.counts.refreshes == refreshes) return;
  const Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) start_volume_[a] += p.volume(a) - p.mass[a] / density[a];
}

void RestingSoil::relax(int sweeps, double time) {
  Particles& p = model_.particles;
  for (int k = 0; k <= sweeps; ++k) {
    prepare();
    dynamics_.accelerations(accelerations_);
    surface_.press(model_, time, accelerations_);
    if (!before_.empty()) relaxation_.measure(p, before_, accelerations_, dt_);
    before_.clear();
    if (k < sweeps && sweeps_ % Relaxation::steps_between == 0) before_ = accelerations_;
    const Kick kick = full_kick(relaxation_.damping, dt_);
    surface_.hold(model_, kick, dt_, time, accelerations_);
    if (k == sweeps) return;
    relaxed_step(model_, dynamics_, kick, dt_, accelerations_);
    ++sweeps_;
  }
}

/// As a step of its own, after which the soil stands still: the fluxes are written once more, without the
/// viscous ones.
void RestingSoil::move_to(std::span<const Vec2> places) {
  Particles& p = model_.particles;
  prepare();
  for (std::size_t a = 0; a < p.size(); ++a) {
    p.velocity[a] = (places[a] - p.position[a]) / dt_;
    p.position[a] = places[a];
  }
  model_.pore_water->follow(model_.water, p, 0, p.size());
  dynamics_.strain(dt_);
  std::ranges::fill(p.velocity, Vec2::Zero());
  dynamics_.strain(0);
  before_.clear();
  ++sweeps_;
}

double RestingSoil::out_of_balance() const {
  const Particles& p = model_.particles;
  const double squares = deterministic_sum(
      p.size(), [&](std::size_t a) { return (p.density[a] * accelerations_[a]).squaredNorm(); });
  return std::sqrt(squares / static_cast<double>(p.size())) * extent_;
}

std::size_t RestingSoil::fastest() const {
  const auto& v = model_.particles.velocity;
  return std::ranges::max_element(v, {}, [](const Vec2& x) { return x.squaredNorm(); }) - v.begin();
}

void RestingSoil::visit(StateArchive& state) {
  state.array("excess_pressure", excess_);
  state.array("volume_at_start", start_volume_);
  state.array("accelerations_at_rest", accelerations_);
  state.value("soil_sweeps", sweeps_);
  relaxation_.visit(state, "flow_relaxation");
}

}  // namespace porosph
