// The water of seepage over time: its balance, and what passes faces, drains and sections.
#pragma once

#include "render/chart.hpp"
#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph::render {

/// Two charts for each run that has them in its history: water that entered and left and that the soil gained
/// since the start, and the discharge through everything that has a name. Empty where no run has.
std::vector<Chart> water_curves(const std::vector<FinishedRun>& runs, const std::vector<std::string>& labels);

}  // namespace porosph::render
