#include "app/bench/timed_run.hpp"

#include <omp.h>

#include <cmath>

#include "solver/run/run.hpp"

namespace porosph::bench {
namespace {

constexpr std::int64_t looks = 400;      ///< at the error, over the longest a run may take
constexpr double settled_within = 0.05;  ///< of the last error

struct Look {
  double seconds, error;
};

/// The first look from which on the error stays near the last one.
double settling_time(const std::vector<Look>& all) {
  const double last = all.back().error;
  std::size_t first = all.size() - 1;
  while (first > 0 && std::abs(all[first - 1].error - last) <= settled_within * last) --first;
  return all[first].seconds;
}

std::string ending_of(RunStatus status) {
  if (status == RunStatus::equilibrium) return "equilibrium";
  if (status == RunStatus::interrupted) return "interrupted";
  return status == RunStatus::unstable ? "unstable" : "end of time";
}

}  // namespace

TimedRun timed_run(const Case& scene, const DynamicsMaker& dynamics, const FemSolution* fem,
                   const std::function<bool()>& time_is_up) {
  omp_set_num_threads(1);
  Seconds since = now();
  Simulation simulation(scene, dynamics);
  double spent = (now() - since).cpu;
  const ReferenceStress reference(simulation, fem);
  const std::int64_t steps_between = std::max<std::int64_t>(1, simulation.last_step() / looks);
  std::vector<Look> all;
  const auto look = [&] {
    spent += (now() - since).cpu;
    all.push_back({spent, reference.error(simulation)});
    since = now();
  };
  since = now();
  const RunOutcome outcome = run(simulation, {.frame = {},
                                              .history = {},
                                              .progress =
                                                  [&](const Simulation& s) {
                                                    if (s.step() % steps_between == 0) look();
                                                  },
                                              .interrupted = time_is_up});
  look();
  return {.particles = static_cast<std::int64_t>(simulation.model().particles.size()),
          .steps = simulation.step(),
          .ending = ending_of(outcome.status),
          .error = all.back().error,
          .seconds = spent,
          .settled = settling_time(all)};
}

}  // namespace porosph::bench
