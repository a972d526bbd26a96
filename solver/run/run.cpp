#include "solver/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "solver/run/energy_budget.hpp"
#include "solver/run/monitor/zigzag.hpp"
#include "solver/run/water_balance.hpp"

namespace porosph {
namespace {

constexpr std::int64_t steps_between_balances = 10, steps_between_energy_checks = 100,
                       steps_between_searches = 200;

/// Forces in balance at one instant may be a vibration passing its middle; they must stay so while a wave
/// crosses the body to and fro. Where damping is critical for the lowest vibration, 2 / omega will do.
class Equilibrium {
 public:
  /// Soil that follows a flow is at rest all the while.
  explicit Equilibrium(const Simulation& s)
      : limit_(s.follows_flow() ? 0 : s.scene().stop.unbalanced_force_ratio) {
    Vec2 low = s.model().particles.start.front(), high = low;
    for (const Vec2& p : s.model().particles.start) low = low.cwiseMin(p), high = high.cwiseMax(p);
    needed_ = 2 * (high - low).maxCoeff() / s.model().wave_speed;
    if (!s.scene().water.level_over_time.empty()) changes_end_ = s.scene().water.level_over_time.back().x();
    changes_end_ = std::max(changes_end_, end_of_shaking(s.scene().shaking));
    for (const LoadCase& load : s.scene().loads)
      if (!load.over_time.empty()) changes_end_ = std::max(changes_end_, load.over_time.back().x());
    for (const FootingCase& footing : s.scene().footings)
      if (!footing.over_time.empty()) changes_end_ = std::max(changes_end_, footing.over_time.back().x());
  }

  /// Keeps the last time out of balance, and the zigzag of displacements, in `progress`.
  bool reached(Simulation& s, RunProgress& progress) const {
    if (limit_ <= 0 || s.step() % steps_between_balances != 0) return false;
    if (s.unbalanced_force_ratio() >= limit_) progress.unbalanced_at = s.time();
    const double c = s.scene().loading.adaptive_damping ? s.damping() : 0;
    const double needed = c > 0 ? std::min(needed_, 4 / c) : needed_;
    return s.time() - std::max(progress.unbalanced_at, changes_end_) >= needed &&
           !zigzag_grows(s, progress, needed);
  }

 private:
  /// Displacements that alternate grow without forces that show: where there are any, they are looked at
  /// again after the same while.
  static bool zigzag_grows(const Simulation& s, RunProgress& progress, double needed) {
    constexpr double small = 0.05, steady = 1.02;
    if (progress.zigzag >= 0 && s.time() - progress.zigzag_at < needed) return true;
    const double before = progress.zigzag, now = measure_zigzag(s.model()).rms;
    progress.zigzag = now, progress.zigzag_at = s.time();
    return now > small && (before < 0 || now > steady * before);
  }

  double limit_, needed_ = 0, changes_end_ = 0;
};

/// Of all stages, there at present or not.
const Case& whole_case(const Simulation& s) { return s.scene().plan ? *s.scene().plan : s.scene(); }

std::vector<double> history_row(Simulation& s) {
  // For the forces of footings and sheets at this instant. Elsewhere the next step asks for them, within the
  // time that counts.
  if (!s.footings().empty() || !s.sheets().empty()) s.accelerations();
  std::vector<double> row = {s.time()};
  if (const auto drained = s.drained()) row.push_back(*drained);
  if (s.base().acts()) row.push_back(s.base().acceleration(s.time()));
  if (s.seepage() != nullptr) {
    const std::vector<double> of_water = water_balance_row(s);
    row.insert(row.end(), of_water.begin(), of_water.end());
  }
  for (const Probe& probe : s.probes()) {
    const std::vector<double> values = probe.read(s.model().particles).values();
    row.insert(row.end(), values.begin(), values.end());
  }
  for (const FootingCase& footing : whole_case(s).footings) {
    const auto there = std::ranges::find(s.footings(), footing.name, &Footing::name);
    if (there == s.footings().end())
      row.insert(row.end(), 3, std::nan(""));
    else
      row.insert(row.end(), {there->force(), there->shear(), there->settlement(s.model().particles)});
  }
  for (const SheetCase& sheet : whole_case(s).sheets) {
    const auto there = std::ranges::find(s.sheets(), sheet.name, &Sheet::name);
    if (there == s.sheets().end()) {
      row.insert(row.end(), 4, std::nan(""));
      continue;
    }
    const Sheet::Extremes most = extremes_of(there->profile());
    row.insert(row.end(), {most.section.moment, most.section.shear, most.section.axial, most.displacement});
  }
  return row;
}

bool has_failed(const Simulation& s) {
  constexpr std::int64_t steps_between_looks = 20;
  if (!(s.scene().stop.displacement < never) || s.moves() % steps_between_looks != 0) return false;
  return s.largest_displacement() > s.scene().stop.displacement;
}

/// Physical damping and viscosity only lose energy, so growth is an error of the motion equation.
double energy_growth(const Simulation::Energy& now, const RunProgress& progress) {
  return progress.most_at_work > 0 ? (now.total() - progress.energy_at_start) / progress.most_at_work : 0;
}

/// The conventional form does work under water (the suction at the surface of eq. 21), and so does a water
/// level that moves or presses on a face, a load that changes, a base that shakes, a footing and a sheet:
/// there energy tells nothing.
bool keeps_energy(const Simulation& s) {
  const Case& scene = s.scene();
  const bool loads_change =
      std::ranges::any_of(scene.loads, [](const LoadCase& load) { return !load.over_time.empty(); });
  return !loads_change && !scene.shaking.acts() && scene.footings.empty() && scene.sheets.empty() &&
         scene.water.level_over_time.empty() && !scene.water.flows() && s.model().loads.empty() &&
         !(scene.water.present() && scene.formulation.motion == Motion::conventional);
}

/// Breakdown that does not show in a single step.
class Guard {
 public:
  explicit Guard(const Simulation& s) : watches_energy_(keeps_energy(s)) {}

  void look(Simulation& s, RunProgress& progress) const {
    if (s.instability() || s.rests_in_flow() || s.moves() % steps_between_energy_checks != 0) return;
    if (s.moves() % steps_between_searches == 0) s.look_for_breakdown();
    if (!s.instability()) weigh_energy(s, progress);
    if (!s.instability()) s.remember();
  }

 private:
  void weigh_energy(Simulation& s, RunProgress& progress) const {
    constexpr double tolerable = 0.5;
    const Simulation::Energy now = s.energy();
    // A vibration has moments of little motion and little strain: its largest is what growth is measured by.
    progress.most_at_work = std::max(progress.most_at_work, now.kinetic + now.elastic);
    const double gained = energy_growth(now, progress);
    if (watches_energy_ && !(gained <= tolerable))
      s.stop(energy_gain(s.model(), s.velocities(), gained, s.time()));
  }

  bool watches_energy_;
};

}  // namespace

Schedule::Schedule(double interval, double time_step, std::int64_t last_step,
                   const std::vector<double>& times, double start)
    : interval_(interval), dt_(time_step), start_(start), last_(last_step) {
  for (const double time : times) at_times_.insert(std::llround((time - start) / time_step));
}

bool Schedule::due(std::int64_t step) const {
  if (step == 0 || step == last_ || at_times_.contains(step)) return true;
  if (interval_ <= 0) return false;
  if (interval_ <= dt_) return true;
  const double nearest = std::round((start_ + static_cast<double>(step) * dt_) / interval_);
  return std::llround((nearest * interval_ - start_) / dt_) == step;
}

std::vector<std::string> history_columns(const Simulation& simulation) {
  std::vector<std::string> columns = {"time"};
  if (simulation.drained()) columns.push_back("water.drained");
  if (simulation.base().acts()) columns.push_back("base.acceleration");
  if (simulation.seepage() != nullptr) {
    const std::vector<std::string> of_water = water_balance_columns(simulation);
    columns.insert(columns.end(), of_water.begin(), of_water.end());
  }
  for (const Probe& probe : simulation.probes())
    for (const std::string& quantity : probe_quantities()) columns.push_back(probe.name() + "." + quantity);
  for (const FootingCase& footing : whole_case(simulation).footings)
    for (const char* quantity : {"Force", "Shear", "Settlement"})
      columns.push_back(footing.name + "." + quantity);
  for (const SheetCase& sheet : whole_case(simulation).sheets)
    for (const char* quantity : {"Moment", "Shear", "Axial", "Displacement"})
      columns.push_back(sheet.name + "." + quantity);
  return columns;
}

void RunProgress::visit(StateArchive& state) {
  state.value("framed", framed);
  state.value("recorded", recorded);
  state.value("energy_at_start", energy_at_start);
  state.value("most_at_work", most_at_work);
  state.value("unbalanced_at", unbalanced_at);
  state.value("zigzag", zigzag);
  state.value("zigzag_at", zigzag_at);
  state.value("stepping_seconds", stepping_seconds);
}

namespace {

/// Frames and rows of the history, each once.
class Recorder {
 public:
  Recorder(Simulation& s, const RunWatch& watch, RunProgress& progress)
      : s_(s),
        watch_(watch),
        progress_(progress),
        frames_(s.scene().output.interval, s.time_step(), s.last_step(), s.scene().output.times,
                s.start_time()),
        rows_(s.scene().output.history_interval > 0 ? s.scene().output.history_interval : s.time_step(),
              s.time_step(), s.last_step(), {}, s.start_time()) {}

  void record(bool frame, bool row) {
    if (frame && progress_.framed != s_.step()) {
      progress_.framed = s_.step();
      if (watch_.frame) watch_.frame(s_);
    }
    if (row && progress_.recorded != s_.step()) {
      progress_.recorded = s_.step();
      if (watch_.history) watch_.history(history_row(s_));
    }
  }
  void record_what_is_due() {
    if (s_.follows_flow() && s_.in_motion()) {
      const bool due = s_.motion_is_due();
      return record(due, due);
    }
    record(frames_.due(s_.step()), rows_.due(s_.step()));
  }

 private:
  Simulation& s_;
  const RunWatch& watch_;
  RunProgress& progress_;
  Schedule frames_, rows_;
};

void begin(Simulation& s, RunProgress& progress, Recorder& recorder) {
  if (progress.has_begun()) {  // the end may be later than it was
    recorder.record_what_is_due();
    return;
  }
  s.begin();
  const Simulation::Energy energy = s.energy();
  progress.energy_at_start = energy.total();
  progress.most_at_work = energy.kinetic + energy.elastic;
  progress.unbalanced_at = progress.zigzag_at = s.start_time();
  if (s.start_time() > 0)  // the stage before ended with what there was to record
    progress.framed = progress.recorded = 0;
  else
    recorder.record(true, true);
}

/// A step, and whether the soil is at rest after it.
bool advance(Simulation& s, const Guard& guard, const Equilibrium& equilibrium, RunProgress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto before = Clock::now();
  s.advance();
  guard.look(s, progress);
  bool settled = !s.instability() && equilibrium.reached(s, progress);
  if (settled) {
    s.look_for_breakdown();
    settled = !s.instability();
  }
  progress.stepping_seconds += std::chrono::duration<double>(Clock::now() - before).count();
  return settled;
}

/// The last frame, and what became of the energy.
void end(Simulation& s, RunProgress& progress, Recorder& recorder, RunOutcome& outcome) {
  outcome.stepping_seconds = progress.stepping_seconds;
  const bool showable = outcome.status != RunStatus::unstable || s.showable();
  if (showable)
    recorder.record(true, true);
  else if (s.exchange_with_last_good()) {
    recorder.record(progress.framed < s.step(), false);
    s.exchange_with_last_good();
  }
  const Simulation::Energy energy = s.energy();
  progress.most_at_work = std::max(progress.most_at_work, energy.kinetic + energy.elastic);
  outcome.energy_growth = showable ? energy_growth(energy, progress) : std::nan("");
  if (showable) outcome.energy = energy_budget(s, progress.energy_at_start);
}

}  // namespace

RunOutcome run(Simulation& s, const RunWatch& watch, RunProgress progress) {
  Recorder recorder(s, watch, progress);
  const Equilibrium equilibrium(s);
  RunOutcome outcome;
  begin(s, progress, recorder);
  const Guard guard(s);
  while (s.step() < s.last_step()) {
    const bool settled = advance(s, guard, equilibrium, progress);
    if (s.instability()) {
      outcome.status = RunStatus::unstable;
      outcome.message = s.instability()->message;
      break;
    }
    const bool failed = !settled && has_failed(s);
    const bool last = s.step() == s.last_step();
    if (last && !settled && watch.checkpoint) watch.checkpoint(s, progress, true);
    recorder.record_what_is_due();
    if (watch.progress) watch.progress(s);
    const bool goes_on = !last && !settled && !failed;
    const bool interrupted = goes_on && watch.interrupted && watch.interrupted();
    if (watch.checkpoint && goes_on) watch.checkpoint(s, progress, interrupted);
    if (failed) {
      outcome.failed = true;
      outcome.message = fmt::format("failed: a particle has moved further than stop.displacement = {:g} m",
                                    s.scene().stop.displacement);
      break;
    }
    if (settled) {
      outcome.status = RunStatus::equilibrium;
      outcome.message =
          fmt::format("unbalanced force ratio below {:g}", s.scene().stop.unbalanced_force_ratio);
    } else if (interrupted) {
      outcome.status = RunStatus::interrupted;
      outcome.message = "stopped by request";
    }
    if (outcome.status != RunStatus::completed) break;
  }
  end(s, progress, recorder, outcome);
  return outcome;
}

}  // namespace porosph
