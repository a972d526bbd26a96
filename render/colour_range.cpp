#include "render/colour_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/nice_ticks.hpp"

namespace porosph {

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

}  // namespace porosph
