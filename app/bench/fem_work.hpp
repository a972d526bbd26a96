// Run time against error of finite elements, the line to beat.
#pragma once

#include "app/bench/work_precision.hpp"
#include "solver/reference/fem/solution.hpp"

namespace porosph::bench {

/// With these triangle edges [m]; the foundation against its exact column, the embankment against the
/// converged probes that come with the cases. One thread.
std::vector<WorkPoint> measure_fem(const Bench& bench, const std::string& scene_name, const Case& scene,
                                   const std::vector<double>& edges);

}  // namespace porosph::bench
