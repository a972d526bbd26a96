// One run, with its time and its error as it proceeds.
#pragma once

#include <functional>

#include "app/bench/reference_stress.hpp"
#include "app/bench/work_precision.hpp"

namespace porosph::bench {

struct TimedRun {
  std::int64_t particles = 0, steps = 0;
  std::string ending;
  double error = 0;                 ///< at the end
  double seconds = 0, settled = 0;  ///< core time as in WorkPoint, making the particles included
};

/// Runs the case on one thread, to its end or until the time is up (then it is "interrupted"). What looking
/// at the error takes is not counted.
TimedRun timed_run(const Case& scene, const DynamicsMaker& dynamics, const FemSolution* fem,
                   const std::function<bool()>& time_is_up = {});

}  // namespace porosph::bench
