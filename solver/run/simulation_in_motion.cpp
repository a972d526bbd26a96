// How a simulation of soil that rested in a flow continues with its inertia once it fails, and how pore
// pressure moves with soil.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/run/energy_budget.hpp"
#include "solver/run/simulation.hpp"
#include "solver/space/place_text.hpp"

namespace porosph {

/// When so many of its intervals have passed since the soil failed.
std::int64_t Simulation::motion_tick(double intervals) const {
  return std::llround((motion_.failed_at + intervals * scene_.water.coupling.motion_interval) / clock_.dt);
}

bool Simulation::motion_is_due() const {
  if (!follows_flow() || !motion_.now) return false;
  return clock_.step ==
         motion_tick(std::round((time() - motion_.failed_at) / scene_.water.coupling.motion_interval));
}

/// The next tick at which something is written.
std::int64_t Simulation::next_due() const {
  if (!motion_.now) return clock_.next_due(scene_.output);
  const double interval = scene_.water.coupling.motion_interval;
  const std::int64_t next = motion_tick(std::floor((time() - motion_.failed_at) / interval + 1e-9) + 1);
  return std::min(clock_.last_step, std::max(next, clock_.step + 1));
}

void Simulation::end_after_motion() {
  const double end = motion_.failed_at + scene_.water.coupling.motion_time;
  clock_.last_step = std::min<std::int64_t>(clock_.last_step, std::llround(end / clock_.dt));
}

/// Equilibrium is lost within a moment from now: the soil continues with its inertia.
void Simulation::begin_motion() {
  watch_.forget();
  motion_.failed_at = time();
  motion_.now = true;
  end_after_motion();
  std::ranges::fill(model_.particles.velocity, Vec2::Zero());
  if (flow_.seepage) flow_.seepage->stop(model_.particles);
  if (motion_.water) {
    motion_.water->go_on_from(*flow_.coupled);
    dynamics_->carry_excess({});  // it acts by itself from here on
  }
  dynamics_->strain(0);  // it remembers velocities
  forces_.valid = false;
  choose_ticks();
  if (!motion_.water || dynamics_->flow() == nullptr) return;
  accelerations();  // water is let through where heads are fixed
  motion_.energy_when_lost = energy_counts(*this);
}

/// The load at the end of the step acts on where that has led.
void Simulation::count_changing_loads() {
  const auto energy = [&](double time) { return load_energy(surface_.loads, model_.particles, time); };
  motion_.given_by_loads += energy(clock_.then()) - energy(time());
}

/// Steps as long as the soil's waves allow, which end where something is due.
void Simulation::choose_ticks() {
  if (!follows_flow()) return;
  const double longest = flow_.settling.dt / clock_.dt;
  const std::int64_t left = next_due() - clock_.step;
  if (left < 1) return;  // beyond the end: steps like the last one
  clock_.ticks = left / static_cast<std::int64_t>(std::ceil(static_cast<double>(left) / longest));
}

/// p_w is that of the water outside, or of a flow, and the excess.
void Simulation::show_excess() {
  Particles& p = model_.particles;
  model_.pore_water->follow(model_.water, p, 0, p.size());
  if (!motion_.water) return;
  const auto excess = motion_.water->excess();
  for (std::size_t a = 0; a < p.size(); ++a) p.pore_pressure[a] += excess[a];
}

/// The pressure at the end of the step acts in it; footings hold against both, and the pressure is that with
/// which they do. Returns false where pressure and soil have parted.
bool Simulation::change_pressure() {
  DynamicWater::Hold hold;
  if (!surface_.footings.empty())
    hold = [this](std::span<Vec2> accelerations) {
      for (const Footing& footing : surface_.footings) footing.hold_alike(model_.particles, accelerations);
    };
  const std::vector<Vec2> held = surface_.hold_soil() ? forces_.accelerations : std::vector<Vec2>();
  try {
    motion_.water->add_change(next_kick(), step_length(), forces_.accelerations, hold);
  } catch (const DynamicWater::Lost& lost) {
    const Vec2 place = model_.particles.position[lost.particle] + model_.origin;
    stop({.cause = Cause::inverted,
          .time = time(),
          .message =
              fmt::format("at {:.6g} s the pore pressure no longer follows the volume of the soil around "
                          "{}: it has yielded too far",
                          time(), place_text(place))});
    return false;
  }
  if (held.empty()) return true;
  for (std::size_t a = 0; a < held.size(); ++a) forces_.accelerations[a] += forces_.unheld[a] - held[a];
  hold_soil(forces_.accelerations);
  return true;
}

void Simulation::visit_motion(StateArchive& state) {
  state.value("in_motion", motion_.now);
  state.value("ticks", clock_.ticks);
  state.value("moves", clock_.moves);
  state.value("failed_at", motion_.failed_at);
  if (!motion_.now) return;
  if (motion_.water) motion_.water->visit(state);
  bool counts_energy = motion_.energy_when_lost.has_value();
  state.value("counts_energy", counts_energy);
  if (counts_energy) {
    if (state.restoring()) motion_.energy_when_lost = Summary::EnergyBudget{};
    std::span<Summary::EnergyBudget> counts(&*motion_.energy_when_lost, 1);
    state.array("energy_when_lost", counts);
    state.value("given_by_loads", motion_.given_by_loads);
  }
  if (!state.restoring() || !follows_flow()) return;
  if (motion_.water) dynamics_->carry_excess({});
  end_after_motion();
}

}  // namespace porosph
