// A run through the stages of its case: one simulation after the other.
#pragma once

#include <memory>

#include "solver/case/stages.hpp"
#include "solver/output/frame.hpp"
#include "solver/run/run.hpp"

namespace porosph::app {

class StagedRun {
 public:
  /// At the beginning of the first stage, which starts from `state` where one is given. Throws as Simulation.
  explicit StagedRun(const Case& scene, const HandedOver* state = nullptr);

  Simulation& simulation() { return *simulation_; }
  const Simulation& simulation() const { return *simulation_; }
  const StagePlan& plan() const { return plan_; }
  bool has_stages() const { return !scene_.stages.empty(); }

  /// Whether the present stage asks for its factor of safety.
  bool asks_for_safety() const { return plan_.table() != nullptr && plan_.table()->safety; }
  /// Notes how the present stage ended, and its factor of safety.
  void end(const RunOutcome& outcome, std::optional<Summary::Safety> safety = std::nullopt);
  /// Whether another stage follows: the present one has come to its end, without failure.
  bool goes_on() const;
  /// Begins the next stage where the present one ended. Throws as Simulation.
  void go_on();

  /// Saves or restores all that changes, the present stage among it. Throws StateError.
  void visit(StateArchive& state);

  const std::vector<Summary::Stage>& ended() const { return ended_; }
  std::int64_t steps() const;           ///< of all stages so far
  std::int64_t particle_steps() const;  ///< of all stages so far

 private:
  void begin(const Beginning& beginning);

  Case scene_;
  StagePlan plan_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<Summary::Stage> ended_;
};

/// Readings of the probes at the present instant, by their names.
std::map<std::string, Summary::Probe> probe_readings(const Simulation& simulation);

/// What holds the footings at the present instant, by their names.
std::map<std::string, Summary::Footing> footing_readings(Simulation& simulation);

}  // namespace porosph::app
