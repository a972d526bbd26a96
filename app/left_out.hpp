// --leave-out X,Y,RADIUS
#pragma once

#include <string>
#include <vector>

#include "vtk_io/finished_run/norms.hpp"

namespace porosph::app {

/// Throws UsageError for what is not three numbers with a positive radius.
std::vector<LeftOut> read_left_out(const std::vector<std::string>& texts);

}  // namespace porosph::app
