// A whole run: from the start to the end time, equilibrium, breakdown or interruption.
#pragma once

#include <functional>
#include <set>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// Steps at which something is due every `interval` seconds: the nearest step to each multiple; every step
/// where the interval is shorter than one; and the nearest steps to `times`. The first and the last step are
/// always due.
class Schedule {
 public:
  /// `start`: time at step 0 [s].
  Schedule(double interval, double time_step, std::int64_t last_step, const std::vector<double>& times = {},
           double start = 0);
  bool due(std::int64_t step) const;

 private:
  double interval_, dt_, start_;
  std::int64_t last_;
  std::set<std::int64_t> at_times_;
};

/// What a run keeps besides its simulation.
struct RunProgress {
  std::int64_t framed = -1, recorded = -1;  ///< steps of the last frame and history row that were due
  double energy_at_start = 0;               ///< [J/m]
  double most_at_work = 0;                  ///< largest kinetic and elastic energy seen [J/m]
  double unbalanced_at = 0;                 ///< last time at which forces were seen out of balance [s]
  double zigzag = -1;                       ///< when last measured at rest [-]; negative: not yet
  double zigzag_at = 0;                     ///< [s]
  double stepping_seconds = 0;              ///< wall time without what the watch did [s]

  bool has_begun() const { return framed >= 0 || recorded >= 0; }
  void visit(StateArchive& state);  ///< saves or restores all of it
};

/// What the caller does during a run. Empty functions are not called.
struct RunWatch {
  std::function<void(Simulation&)> frame;                       ///< a frame is due (output.interval)
  std::function<void(const std::vector<double>& row)> history;  ///< a row of history_columns()
  std::function<void(const Simulation&)> progress;              ///< after every step
  std::function<bool()> interrupted;                            ///< true ends the run after this step
  /// After every step from which a run can be resumed: the place to save simulation and progress. `ending`:
  /// the run was interrupted, or reached its end time. What it writes next does not belong to a run that is
  /// resumed from here (one with a later end may have no frame at this step).
  std::function<void(Simulation&, RunProgress&, bool ending)> checkpoint = {};
};

struct RunOutcome {
  RunStatus status = RunStatus::completed;
  std::string message;       ///< where and why, unless completed
  bool failed = false;       ///< the soil has moved further than the case calls failure
  double energy_growth = 0;  ///< as in Summary; not a number where the state has broken down
  std::optional<Summary::EnergyBudget> energy;  ///< as in Summary
  double stepping_seconds = 0;                  ///< wall time without what the watch did [s]
};

/// Advances to the end, from the start or from where a restored `progress` left off. The last frame and
/// history row are of the state at which the run ended; in place of a state that has broken down the last
/// frame is of the last good one, 100 to 200 steps before.
RunOutcome run(Simulation& simulation, const RunWatch& watch, RunProgress progress = {});

/// "time", then "<probe>.<quantity>".
std::vector<std::string> history_columns(const Simulation& simulation);

}  // namespace porosph
