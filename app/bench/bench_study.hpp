// All measurements, as one study.
#pragma once

#include "app/bench/bench.hpp"

namespace porosph::bench {

/// "throughput", "phases", "work-precision", in the order in which they are made.
const std::vector<std::string>& measurement_names();

/// Makes the measurements, or those of `only`, and writes the study into the options' folder. Returns what a
/// person wants to see of it on the terminal. Throws WriteError, CaseError, std::runtime_error.
std::string run_bench(const BenchOptions& options, const std::vector<std::string>& only,
                      const std::string& command);

}  // namespace porosph::bench
