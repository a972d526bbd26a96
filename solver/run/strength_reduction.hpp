// The factor of safety by strength reduction: the divisor of all strength at which a body at rest gives way.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/run/simulation.hpp"

namespace porosph {

/// How a trial with divided strength ended.
enum class TrialEnd {
  at_rest,      ///< forces are in balance: stable
  moved_far,    ///< displacements beyond what a body at rest has: failed
  flows,        ///< moves on and on, as fast as before: failed
  not_at_rest,  ///< in motion after the longest time: failed
  broke_down,   ///< the state is no longer one of soil: failed
};

struct StrengthTrial {
  double factor = 0;  ///< that cohesion and tan(phi) are divided by
  TrialEnd end = TrialEnd::at_rest;
  double displacement = 0;  ///< largest of all particles, at the end [m]
  double unbalanced = 0;    ///< unbalanced force ratio at the end [-]
  std::int64_t steps = 0;
  bool stable() const { return end == TrialEnd::at_rest; }
};

struct StrengthReduction {
  double stable_at = 0;               ///< largest factor at which the body comes to rest; 0: none was found
  double fails_at = never;            ///< smallest at which it does not; infinite: none was found
  double at_rest = 0;                 ///< largest displacement of elastic soil at rest [m]
  std::vector<StrengthTrial> trials;  ///< by their factor
  std::unique_ptr<Simulation> mechanism;  ///< the trial at `fails_at`, as it ended; empty if there is none
  std::vector<double> strain_before;      ///< plastic strain of its particles before all trials; empty: none
};

struct StrengthReductionOptions {
  double bracket = 0.01;             ///< width at which the search ends: fails_at - stable_at
  double first_guess = 1.3;          ///< where to begin
  double lower_guess = never;        ///< a second below it, where there are two; the factor may be between
  double least = 0.05, most = 50;    ///< factors beyond which no more are tried
  int jobs = 1;                      ///< trials at a time, each on one core
  const HandedOver* from = nullptr;  ///< state of the body, which trials begin with; null: that at the start
  std::function<void(const StrengthTrial&)> finished = {};  ///< after each, by one thread at a time
  std::function<bool()> interrupted = {};                   ///< true ends the search
};

/// The case with cohesion, undrained strength and tan(phi) divided by a factor > 0.
Case weakened(const Case& scene, double factor);

/// How long a trial may take to come to rest, 40 of the body's longest periods [s].
double longest_rest(const Case& scene);

/// Divides strength by factors from a bracket that gets narrower, each trial from the rest with the largest
/// factor so far, the first from `from`, or else the unstressed or K0 state at the start. Stable: the
/// unbalanced force ratio falls below 1e-4 within 40 of the body's longest periods and before displacements
/// exceed 5 times those at rest (the ratio alone would take a failed slope for stable that has flowed to a
/// new rest); where trials begin with a state, displacements count from there. Throws std::runtime_error
/// where the case cannot be built or has no factor (safety_obstacle).
StrengthReduction reduce_strength(const Case& scene, const StrengthReductionOptions& options);

}  // namespace porosph
