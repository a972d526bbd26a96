#include "solver/simulation/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace porosph {
namespace {

constexpr std::int64_t steps_between_balances = 10, steps_between_separation_checks = 200;

/// Forces in balance at one instant may be a vibration passing its middle; they must stay so while a wave
/// crosses the body to and fro.
class Equilibrium {
 public:
  explicit Equilibrium(const Simulation& s) : limit_(s.scene().stop.unbalanced_force_ratio) {
    Vec2 low = s.model().particles.position.front(), high = low;
    for (const Vec2& p : s.model().particles.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    needed_ = 2 * (high - low).maxCoeff() / s.model().wave_speed;
  }

  bool reached(Simulation& s) {
    if (limit_ <= 0 || s.step() % steps_between_balances != 0) return false;
    if (s.unbalanced_force_ratio() >= limit_) since_ = s.time();
    return s.time() - since_ >= needed_;
  }

 private:
  double limit_, needed_ = 0, since_ = 0;
};

std::vector<double> history_row(const Simulation& s) {
  std::vector<double> row = {s.time()};
  for (const Probe& probe : s.probes()) {
    const std::vector<double> values = probe.read(s.model().particles).values();
    row.insert(row.end(), values.begin(), values.end());
  }
  return row;
}

/// Physical damping and viscosity only lose energy, so growth is an error of the motion equation.
double energy_growth(const Simulation::Energy& now, double at_start) {
  const double at_work = now.kinetic + now.elastic;
  return at_work > 0 ? (now.total() - at_start) / at_work : 0;
}

}  // namespace

Schedule::Schedule(double interval, double time_step, std::int64_t last_step,
                   const std::vector<double>& times)
    : interval_(interval), dt_(time_step), last_(last_step) {
  for (const double time : times) at_times_.insert(std::llround(time / time_step));
}

bool Schedule::due(std::int64_t step) const {
  if (step == 0 || step == last_ || at_times_.contains(step)) return true;
  if (interval_ <= 0) return false;
  if (interval_ <= dt_) return true;
  const double nearest = std::round(static_cast<double>(step) * dt_ / interval_);
  return std::llround(nearest * interval_ / dt_) == step;
}

std::vector<std::string> history_columns(const Simulation& simulation) {
  std::vector<std::string> columns = {"time"};
  for (const Probe& probe : simulation.probes())
    for (const std::string& quantity : probe_quantities()) columns.push_back(probe.name() + "." + quantity);
  return columns;
}

RunOutcome run(Simulation& s, const RunWatch& watch) {
  using Clock = std::chrono::steady_clock;
  const OutputCase& output = s.scene().output;
  const Schedule frames(output.interval, s.time_step(), s.last_step(), output.times);
  const double history_interval = output.history_interval > 0 ? output.history_interval : s.time_step();
  const Schedule rows(history_interval, s.time_step(), s.last_step());
  Equilibrium equilibrium(s);
  RunOutcome outcome;
  std::int64_t framed = -1, recorded = -1;
  const auto record = [&](bool frame_due, bool row_due) {
    if (frame_due && watch.frame && framed != s.step()) watch.frame(s), framed = s.step();
    if (row_due && watch.history && recorded != s.step()) watch.history(history_row(s)), recorded = s.step();
  };

  const double energy_at_start = s.energy().total();
  record(true, true);
  while (s.step() < s.last_step()) {
    const auto before = Clock::now();
    s.advance();
    if (s.step() % steps_between_separation_checks == 0) s.look_for_separation();
    const bool settled = !s.instability() && equilibrium.reached(s);
    outcome.stepping_seconds += std::chrono::duration<double>(Clock::now() - before).count();
    if (s.instability()) {
      outcome.status = RunStatus::unstable;
      outcome.message = *s.instability();
      break;
    }
    record(frames.due(s.step()), rows.due(s.step()));
    if (watch.progress) watch.progress(s);
    if (settled) {
      outcome.status = RunStatus::equilibrium;
      outcome.message =
          fmt::format("unbalanced force ratio below {:g}", s.scene().stop.unbalanced_force_ratio);
    } else if (watch.interrupted && watch.interrupted()) {
      outcome.status = RunStatus::interrupted;
      outcome.message = "stopped by request";
    }
    if (outcome.status != RunStatus::completed) break;
  }
  const bool showable = outcome.status != RunStatus::unstable || s.showable();
  if (showable) record(true, true);
  outcome.energy_growth = showable ? energy_growth(s.energy(), energy_at_start) : std::nan("");
  return outcome;
}

}  // namespace porosph
