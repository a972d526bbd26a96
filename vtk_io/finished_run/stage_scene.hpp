// The case of the stage that a frame shows.
#pragma once

#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph {

/// The run's case as it was at a time [s]: that of the stage then, where it has stages. The run has a case.
Case scene_during(const FinishedRun& run, double time);

}  // namespace porosph
