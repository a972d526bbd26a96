// The story of a run, for summary.json and for the last lines on the terminal.
#pragma once

#include "solver/run/run.hpp"

namespace porosph::app {

Summary summarise(Simulation& simulation, const RunOutcome& outcome, double wall_seconds);

/// A few lines for a person: how it ended, probes, errors, speed.
std::string tell(const Summary& summary);

}  // namespace porosph::app
