// Runs a case through its stages.
#pragma once

#include <catch2/catch.hpp>
#include <memory>

#include "solver/case/stages.hpp"
#include "solver/run/run.hpp"

namespace porosph {

/// Of a stage that has ended.
struct EndedStage {
  std::string name;
  RunOutcome outcome;
  double time = 0;
};

/// The simulation of the last stage, as it ended; `watch` sees each at its end.
inline std::unique_ptr<Simulation> run_stages(
    const Case& scene, const std::function<void(const EndedStage&, Simulation&)>& watch = {}) {
  StagePlan plan(scene);
  auto simulation = std::make_unique<Simulation>(plan.scene());
  while (true) {
    const RunOutcome outcome = run(*simulation, {});
    if (watch) watch({plan.name(), outcome, simulation->time()}, *simulation);
    if (plan.is_last()) return simulation;
    const HandedOver state = simulation->hand_over();
    const double time = simulation->time();
    REQUIRE(plan.go_on(time).empty());
    simulation = std::make_unique<Simulation>(
        plan.scene(),
        Beginning{.time = time, .state = &state, .reset_displacements = plan.resets_displacements()});
  }
}

}  // namespace porosph
