#include "render/colour_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "render/nice_ticks.hpp"

namespace porosph::render {

namespace {

constexpr double noise = 1e-10;  // a spread this small relative to the values is rounding, not a field

ValueRange around(double value) {
  if (value == 0) return {-1, 1};
  const double half = nice_step(0.1 * std::abs(value));
  const double centre = half * std::round(value / half);
  return {centre - half, centre + half};
}

}  // namespace

ValueRange finite_extent(std::span<const double> values) {
  ValueRange extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  }
  return extent;
}

ValueRange robust_extent(std::span<const double> values) {
  const ValueRange whole = finite_extent(values);
  std::vector<double> finite;
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  const std::size_t few = finite.size() / 200;
  if (few == 0) return whole;
  const auto nth = [&](std::size_t n) {
    std::ranges::nth_element(finite, finite.begin() + static_cast<std::ptrdiff_t>(n));
    return finite[n];
  };
  const ValueRange core{nth(few), nth(finite.size() - 1 - few)};
  return core.high - core.low < (whole.high - whole.low) * 2 / 3 && core.low < core.high ? core : whole;
}

ValueRange usual_extent(std::span<const ValueRange> extents) {
  std::vector<double> spans;
  for (const ValueRange& e : extents)
    if (e.low <= e.high) spans.push_back(e.high - e.low);
  double widest = std::numeric_limits<double>::infinity();
  if (spans.size() >= 3) {
    const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
    std::ranges::nth_element(spans, middle);
    if (*middle > 0) widest = 1.5 * *middle;
  }
  std::vector<double> ends;
  for (const ValueRange& e : extents)
    if (e.low <= e.high && e.high - e.low <= widest) ends.insert(ends.end(), {e.low, e.high});
  return finite_extent(ends);
}

ValueRange rounded_range(ValueRange extent) {
  if (!(extent.low <= extent.high)) return {};
  const double largest = std::max(std::abs(extent.low), std::abs(extent.high));
  if (extent.high - extent.low <= noise * largest) return around(0.5 * (extent.low + extent.high));
  const double step = nice_step((extent.high - extent.low) / 20);
  const double hair = 1e-6;  // of a step: rounding errors must not cost a whole step
  return {step * std::floor(extent.low / step + hair), step * std::ceil(extent.high / step - hair)};
}

ValueRange centred_range(ValueRange extent) {
  if (!(extent.low <= extent.high)) return {-1, 1};
  const double largest = std::max(std::abs(extent.low), std::abs(extent.high));
  if (largest == 0) return {-1, 1};
  const double high = rounded_range({-largest, largest}).high;
  return {-high, high};
}

}  // namespace porosph::render
