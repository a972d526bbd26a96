// Probe readings as lines of a chart, with what theory says.
#pragma once

#include <optional>

#include "render/chart.hpp"
#include "vtk_io/finished_run/finished_run.hpp"

namespace porosph::render {

/// A probe's reading over time times `factor`; empty if the run has no such probe or no history.
std::optional<ChartSeries> history_line(const FinishedRun& run, const std::string& probe,
                                        const std::string& quantity, double factor);

/// The state of rest that theory gives at the probe, SI: of EffectiveStress_XX, _YY, _ZZ and Displacement_Y
/// where the case has the reference `column`.
std::optional<double> theory_at(const Case& scene, const ProbeCase& probe, const std::string& quantity);

/// EffectiveStress_YY over time of a column that is suddenly loaded (small strains), for an undamped case
/// with the reference `column`, times `factor`; empty for other cases.
std::optional<ChartSeries> exact_vibration(const Case& scene, const ProbeCase& probe, double factor);

/// σ'yy as a time chart at each probe, all runs in one, with theory. Empty if no run has a history.
std::vector<Chart> stress_histories(const std::vector<FinishedRun>& runs,
                                    const std::vector<std::string>& labels);

/// Says in the line's label where a run broke down or was interrupted, and marks its end.
void mark_end(ChartSeries& series, const FinishedRun& run);

/// An upright line where each stage of a run begins but the first, named as the stage. Call it before
/// show_days_if_long.
void mark_stages(Chart& chart, const FinishedRun& run);

/// Every run has its own colour, dashes tell them apart without colour.
void style(ChartSeries& series, std::size_t run);

}  // namespace porosph::render
