#include "render/run/time_axis.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace porosph::render {
namespace {

constexpr double day = 86400, longest_in_seconds = 2 * day;

}  // namespace

ChartAxis time_axis() { return {.title = "t [s]"}; }

void show_days_if_long(Chart& chart) {
  double longest = 0;
  for (const ChartSeries& line : chart.series)
    for (const double time : line.x) longest = std::max(longest, time);
  if (longest <= longest_in_seconds) return;
  chart.x.title = "t [d]";
  for (ChartSeries& line : chart.series)
    for (double& time : line.x) time /= day;
  for (UprightLine& upright : chart.uprights) upright.x /= day;
}

std::string short_time(double seconds) {
  return seconds > longest_in_seconds ? fmt::format("{:.3g} d", seconds / day)
                                      : fmt::format("{:.3g} s", seconds);
}

}  // namespace porosph::render
