// Watches a simulation for signs that it has broken down.
#pragma once

#include <optional>

#include "solver/run/monitor/instability.hpp"

namespace porosph {

class BreakdownWatch {
 public:
  /// Of a body as it begins.
  BreakdownWatch(const Case& scene, const Model& model);

  /// Looks for particles that have met, left the body or gone through a wall, and for soil too stiff for the
  /// time step (costs a neighbour search).
  void look(const Model& model, double time);
  /// After a step in which so many particles ran away.
  void after_step(std::int64_t runaways, const Model& model, double time);
  void stop(Breakdown reason) { found_ = std::move(reason); }
  void forget() { found_.reset(); }

  /// What went wrong, where, and what usually causes it; empty while all is well.
  const std::optional<Breakdown>& found() const { return found_; }
  /// The state is not finite, or faster than its own waves.
  bool ran_away() const { return ran_away_; }

 private:
  void name_runaway(const Model& model, double time);

  double closest_ = 0;       ///< distance of the two nearest particles at the start [m]
  std::int64_t bodies_ = 0;  ///< at the start; only where they may not part
  bool may_part_, is_conventional_;
  std::optional<Breakdown> found_;
  bool ran_away_ = false;
};

}  // namespace porosph
