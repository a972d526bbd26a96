#include "render/chart_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/nice_ticks.hpp"

namespace porosph::render {

namespace {

void check(const ChartAxis& axis) {
  const ValueRange range = *axis.range;
  const bool finite = std::isfinite(range.low) && std::isfinite(range.high);
  if (finite && range.low < range.high && (!axis.logarithmic || range.low > 0)) return;
  throw std::runtime_error(fmt::format(
      "render: range {} to {} of chart axis '{}'; allowed are finite bounds, the lower "
      "first{}",
      range.low, range.high, axis.title, axis.logarithmic ? ", above 0 on a logarithmic axis" : ""));
}

/// Bounds that all but reach a tick do so: a history up to 3.999 s has one at 4 s.
ValueRange snapped(ValueRange range) {
  const double span = range.high - range.low, step = nice_step(0.1 * span);
  const double low = step * std::floor(range.low / step), high = step * std::ceil(range.high / step);
  return {range.low - low < 0.01 * span ? low : range.low,
          high - range.high < 0.01 * span ? high : range.high};
}

/// `air`: added at both ends, as a fraction of the span.
Axis fit(const ChartAxis& wanted, std::vector<double> values, double air) {
  Axis axis{0, 1, wanted.logarithmic, wanted.title};
  if (wanted.range) {
    check(wanted);
    axis.low = wanted.range->low;
    axis.high = wanted.range->high;
    return axis;
  }
  std::erase_if(values, [&](double value) { return !showable(axis, value); });
  if (axis.logarithmic)
    for (double& value : values) value = std::log10(value);
  ValueRange extent = finite_extent(values);
  if (values.empty())
    extent = {0, 1};
  else if (extent.high - extent.low <= 1e-10 * std::max(std::abs(extent.low), std::abs(extent.high)))
    extent = axis.logarithmic ? ValueRange{extent.low - 0.5, extent.high + 0.5} : rounded_range(extent);
  const double margin = values.empty() ? 0 : air * (extent.high - extent.low);
  extent = {extent.low - margin, extent.high + margin};
  if (!axis.logarithmic) extent = snapped(extent);
  axis.low = axis.logarithmic ? std::pow(10., extent.low) : extent.low;
  axis.high = axis.logarithmic ? std::pow(10., extent.high) : extent.high;
  return axis;
}

bool has_markers(const Chart& chart) {
  return std::ranges::any_of(chart.series, [](const auto& series) { return series.marker != Marker::none; });
}

}  // namespace

bool showable(const Axis& axis, double value) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

Axis x_axis_of(const Chart& chart) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series)
    values.insert(values.end(), series.x.begin(), series.x.end());
  return fit(chart.x, values, chart.x.logarithmic || has_markers(chart) ? 0.05 : 0);
}

Axis y_axis_of(const Chart& chart) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series)
    values.insert(values.end(), series.y.begin(), series.y.end());
  for (const ReferenceLine& reference : chart.references) values.push_back(reference.y);
  return fit(chart.y, values, 0.06);
}

}  // namespace porosph::render
