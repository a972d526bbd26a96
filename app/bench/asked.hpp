// What is asked of the solver's speed, beside what was measured.
#pragma once

#include <optional>

#include "app/bench/phases.hpp"
#include "app/bench/throughput.hpp"
#include "app/bench/work_precision.hpp"

namespace porosph::bench {

/// Heads, then one row per line that could be measured: what, asked, measured, ratio of measured to asked.
std::vector<std::vector<std::string>> asked_table(const std::optional<Throughput>& throughput,
                                                  const std::optional<WorkPrecision>& work, int threads);

}  // namespace porosph::bench
