#include "app/bench/work_precision.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <optional>

#include "app/bench/fem_work.hpp"
#include "app/bench/strategies.hpp"
#include "app/bench/timed_run.hpp"
#include "solver/reference/fem/solve.hpp"
#include "vtk_io/fem_mesh.hpp"

namespace porosph::bench {
namespace {

/// Runs shorter than this are made three times [s].
double worth_repeating(bool quick) { return quick ? 0.5 : 3; }

constexpr double until = 0.95;  ///< of all the time; the rest is for pictures

std::string name_of(const Plan& p) {
  return fmt::format("{}, {}, {}, spacing {:.3g} m", p.scene.name, p.form, p.strategy, p.spacing);
}

/// How long a run will take at most, learned from those before.
class Expectation {
 public:
  double seconds(const Plan& plan, const Simulation& simulation) const {
    const auto found = per_particle_step_.find(plan.form);
    const double each = found != per_particle_step_.end() ? found->second : 1e-6;
    return each * static_cast<double>(simulation.last_step()) *
           static_cast<double>(simulation.model().particles.size()) * share(plan);
  }
  void learn(const Plan& plan, const TimedRun& run) {
    per_particle_step_[plan.form] =
        run.seconds / static_cast<double>(run.steps) / static_cast<double>(run.particles);
  }

 private:
  /// Runs that stop at rest do so long before their end.
  static double share(const Plan& plan) {
    if (plan.strategy == fast_strategy) return 0.1;
    return plan.strategy == paper_strategy ? 1 : 0.4;
  }
  std::map<std::string, double> per_particle_step_;
};

struct Measured {
  Plan plan;
  Case scene;
  TimedRun run;
  std::vector<double> seconds, settled;
};

WorkPoint point_of(const Measured& m) {
  return {.scene = m.plan.scene.name,
          .form = m.plan.form,
          .strategy = m.plan.strategy,
          .spacing = m.plan.spacing,
          .particles = m.run.particles,
          .steps = m.run.steps,
          .ending = m.run.ending,
          .error = m.run.error,
          .seconds = spread_of(m.seconds),
          .settled = spread_of(m.settled)};
}

/// The plan's case; nothing where it has to be left out, which the page says.
std::optional<Case> affordable(Bench& bench, const Plan& plan, const Expectation& expectation) {
  const std::filesystem::path file = bench.options().cases / plan.file();
  if (!std::filesystem::exists(file)) {
    bench.leave_out(name_of(plan), "there is no " + file.string());
    return std::nullopt;
  }
  Case scene = read(bench, plan.file(), plan.overrides());
  const Simulation trial(scene);
  const auto n = static_cast<std::int64_t>(trial.model().particles.size());
  if (n > bench.options().particles) {
    bench.leave_out(name_of(plan), fmt::format("{} particles are more than --particles", n));
    return std::nullopt;
  }
  if (!bench.affords(name_of(plan), expectation.seconds(plan, trial), until)) return std::nullopt;
  return scene;
}

}  // namespace

const WorkPoint* WorkPrecision::find(const std::string& scene, const std::string& form,
                                     const std::string& strategy, double spacing) const {
  for (const WorkPoint& p : points)
    if (p.scene == scene && p.form == form && p.strategy == strategy && std::abs(p.spacing - spacing) < 1e-9)
      return &p;
  return nullptr;
}

WorkPrecision measure_work_precision(Bench& bench) {
  const bool quick = bench.options().quick;
  WorkPrecision work;
  bench.tell("finite elements");
  const Case embankment = read(bench, "embankment.toml", {});
  const FemSolution fem = solve_fem(embankment, mesh_case(embankment, quick ? 1 : 0.5));
  for (const Scene& scene : scenes()) {
    const std::vector<double> edges = quick ? std::vector{4., 1.} : std::vector{4., 2., 1., 0.6};
    for (const WorkPoint& p : measure_fem(bench, scene.name, read(bench, scene.file, scene.overrides), edges))
      work.points.push_back(p);
  }

  Expectation expectation;
  std::vector<Measured> all;
  const auto time_is_up = [&] { return bench.seconds_left() < (1 - until) * bench.options().seconds; };
  const auto measure = [&](Measured& m) {
    const DynamicsMaker dynamics = m.plan.plain ? DynamicsMaker(make_plain_dynamics) : make_dynamics;
    const TimedRun r = timed_run(m.scene, dynamics, m.plan.scene.exact ? nullptr : &fem, time_is_up);
    if (r.ending == "interrupted") return false;
    m.run = r;
    m.seconds.push_back(r.seconds), m.settled.push_back(r.settled);
    return true;
  };
  std::vector<std::string> too_late;
  for (const Plan& plan : plans(quick)) {
    if (time_is_up()) {
      too_late.push_back(name_of(plan));
      continue;
    }
    const std::optional<Case> scene = affordable(bench, plan, expectation);
    if (!scene) continue;
    all.push_back({.plan = plan, .scene = *scene, .run = {}, .seconds = {}, .settled = {}});
    if (!measure(all.back())) {
      bench.leave_out(name_of(plan), "had not ended when the time was up");
      all.pop_back();
      continue;
    }
    expectation.learn(plan, all.back().run);
    bench.tell(fmt::format("{}: error {:.3g} % in {:.3g} s", name_of(plan), 100 * all.back().run.error,
                           all.back().run.seconds));
  }
  if (!too_late.empty())
    bench.leave_out(fmt::format("{} runs ({})", too_late.size(), fmt::join(too_late, "; ")),
                    "the time was up");
  for (int round = 0; round < 2; ++round)  // again, in turns
    for (Measured& m : all)
      if (m.run.seconds < worth_repeating(quick) &&
          bench.seconds_left() > (1 - until) * bench.options().seconds + 3)
        measure(m);
  for (const Measured& m : all) work.points.push_back(point_of(m));
  return work;
}

}  // namespace porosph::bench
