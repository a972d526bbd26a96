// Where a step's time goes.
#pragma once

#include "app/bench/bench.hpp"
#include "app/bench/statistics.hpp"
#include "render/report/study.hpp"

namespace porosph::bench {

struct PhaseCost {
  std::string form;
  std::int64_t particles = 0;
  std::string phase;
  Spread nanoseconds;  ///< of core time per particle and step
};

struct Phases {
  std::vector<PhaseCost> costs;
};

Phases measure_phases(Bench& bench);

/// Writes phases.csv, phases.png.
render::StudySection show_phases(const Phases& phases, const Bench& bench);

}  // namespace porosph::bench
