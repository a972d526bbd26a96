// The story of a run, for summary.json and for the last lines on the terminal.
#pragma once

#include "app/staged_run.hpp"

namespace porosph::app {

/// `outcome`: of the last stage.
Summary summarise(StagedRun& run, const RunOutcome& outcome, double wall_seconds);

/// A few lines for a person: how it ended, probes, errors, speed.
std::string tell(const Summary& summary);

}  // namespace porosph::app
