// Time in seconds, or where it is long in days.
#pragma once

#include <string>

#include "render/chart.hpp"

namespace porosph::render {

/// An axis of time for lines in seconds, which show_days_if_long may change.
ChartAxis time_axis();

/// Shows days along x where the lines, in seconds until then, are longer than two of them: charts of one run
/// then agree.
void show_days_if_long(Chart& chart);

/// "0.0919 s", "4.15 d": by the same rule, to three digits.
std::string short_time(double seconds);

}  // namespace porosph::render
