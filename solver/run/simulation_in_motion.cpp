// How a simulation of soil that rested in a flow goes on with its inertia once it fails, and how pore
// pressure moves with soil.
#include <algorithm>
#include <cmath>

#include "solver/run/simulation.hpp"

namespace porosph {

/// When so many of its intervals have passed since the soil failed.
std::int64_t Simulation::motion_tick(double intervals) const {
  return std::llround((failed_at_ + intervals * scene_.water.coupling.motion_interval) / clock_.dt);
}

bool Simulation::motion_is_due() const {
  if (!follows_flow() || !in_motion_) return false;
  return clock_.step ==
         motion_tick(std::round((time() - failed_at_) / scene_.water.coupling.motion_interval));
}

void Simulation::end_after_motion() {
  const double end = failed_at_ + scene_.water.coupling.motion_time;
  clock_.last_step = std::min<std::int64_t>(clock_.last_step, std::llround(end / clock_.dt));
}

/// Equilibrium is lost within a moment from now: the soil goes on with its inertia.
void Simulation::begin_motion() {
  failed_at_ = time();
  in_motion_ = true;
  end_after_motion();
  std::ranges::fill(model_.particles.velocity, Vec2::Zero());
  seepage_->stop(model_.particles);
  moving_water_->begin_drained();
  dynamics_->strain(0);  // it remembers velocities
  accelerations_valid_ = false;
}

/// Steps as long as the soil's waves allow, which end where something is due.
void Simulation::choose_ticks() {
  if (!follows_flow()) return;
  const double longest = settling_.dt / clock_.dt;
  const std::int64_t left = next_tick_due() - clock_.step;
  clock_.ticks = left / static_cast<std::int64_t>(std::ceil(static_cast<double>(left) / longest));
}

/// p_w is that of the water outside, or of a flow, and the excess.
void Simulation::show_excess() {
  Particles& p = model_.particles;
  model_.pore_water->follow(model_.water, p, 0, p.size());
  const auto excess = moving_water_->excess();
  for (std::size_t a = 0; a < p.size(); ++a) p.pore_pressure[a] += excess[a];
}

/// The pressure at the end of the step acts in it; footings hold against both.
void Simulation::change_pressure() {
  if (footings_.empty()) return moving_water_->add_change(next_kick(), step_length(), accelerations_);
  const std::vector<Vec2> held = accelerations_;
  moving_water_->add_change(next_kick(), step_length(), accelerations_);
  for (std::size_t a = 0; a < held.size(); ++a) accelerations_[a] += unheld_[a] - held[a];
  hold_footings();
}

void Simulation::visit_motion(StateArchive& state) {
  state.value("in_motion", in_motion_);
  state.value("ticks", clock_.ticks);
  state.value("moves", clock_.moves);
  state.value("failed_at", failed_at_);
  if (!in_motion_) return;
  moving_water_->visit(state);
  if (!state.restoring()) return;
  if (follows_flow()) end_after_motion();
}

}  // namespace porosph
