// The tables of a report: the first row is the head, the first column says what each row is, then one for
// each run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/report/report_pictures.hpp"

namespace porosph::render {

using Rows = std::vector<std::vector<std::string>>;

/// How each run ended, and how it was computed.
Rows run_table(const std::vector<LoadedRun>& runs);
/// Shares of what gravity released; no row but the head where no run has an energy budget.
Rows energy_table(const std::vector<LoadedRun>& runs);
/// What flows into the soil through each face of the first run's case, and in all; no row but the head where
/// no run has steady seepage. Runs with other faces have the sums only.
Rows water_table(const std::vector<LoadedRun>& runs);
/// Differences from the exact solution; no row but the head where no run has one.
Rows error_table(const std::vector<LoadedRun>& runs);
/// Differences from finite elements, `norms` beside the runs.
Rows fem_table(const std::vector<LoadedRun>& runs, const std::vector<std::vector<FieldNorms>>& norms);
/// Last values at the probes, with the exact solution's and finite elements' where they are known.
Rows probe_table(const std::vector<LoadedRun>& runs, const std::optional<FemReference>& fem);
/// Settings of the cases that differ; no row but the head where none does.
Rows settings_table(const std::vector<LoadedRun>& runs);

/// A table as GitHub and GitLab show it.
std::string markdown(const Rows& rows);

/// By this format of fmt, or a dash where the value is not finite.
std::string number(double value, const char* format);

}  // namespace porosph::render
