// Tells a person how far a run is.
#pragma once

#include <chrono>

#include "solver/run/simulation.hpp"

namespace porosph::app {

/// On a terminal one line that is written over, otherwise a plain line every ten seconds. Writes to standard
/// error.
class Progress {
 public:
  Progress(bool quiet, const Simulation& simulation);
  void show(const Simulation& simulation);
  void finish();  ///< leaves the line that was written over

 private:
  using Clock = std::chrono::steady_clock;
  std::int64_t first_step_;
  bool quiet_, terminal_, line_open_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace porosph::app
