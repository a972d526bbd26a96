// Computes the points of a sweep, several at a time.
#pragma once

#include <optional>

#include "solver/sweep/judge.hpp"

namespace porosph {

/// What the caller does during a sweep; called by one thread at a time.
struct SweepWatch {
  /// The verdict of a run that was computed before, by its fingerprint. May be empty.
  std::function<std::optional<Verdict>(std::size_t point, const std::string& fingerprint)> known;
  std::function<void(std::size_t point, const std::string& fingerprint, const Verdict&)> finished;
  std::function<bool()> interrupted;  ///< true ends the sweep; asked by many threads
};

/// One verdict per point, in the sweep's order; empty where it was interrupted. Each run has one thread,
/// `jobs` of them run at a time. A point whose case is wrong is `refused`; a base case that cannot be read
/// throws CaseError.
std::vector<std::optional<Verdict>> run_sweep(const Sweep& sweep, const MeasureMaker& measure, int jobs,
                                              const SweepWatch& watch);

/// Which values of an axis leave the sweep's case as it is.
std::vector<bool> usual_values(const Sweep& sweep, const SweepAxis& axis);

}  // namespace porosph
