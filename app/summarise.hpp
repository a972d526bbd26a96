// The story of a run, for summary.json and for the last lines on the terminal.
#pragma once

#include "app/staged_run.hpp"

namespace porosph::app {

/// `outcome`: of the last stage.
Summary summarise(StagedRun& run, const RunOutcome& outcome, double wall_seconds);

/// A few lines for a person: how it ended, probes, errors, speed.
std::string tell(const Summary& summary);

/// Soil -> inertia over mass, of those soils of a case whose inertia is scaled.
std::map<std::string, double> scaled_inertia(const Case& scene);
/// That, for a person.
std::string inertia_text(const std::map<std::string, double>& scaled);

}  // namespace porosph::app
