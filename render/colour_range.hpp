// The interval of values that a colour bar spans.
#pragma once

#include <span>

namespace porosph::render {

struct ValueRange {
  double low = 0, high = 1;
  bool operator==(const ValueRange&) const = default;
};

/// Smallest and largest finite value; low > high if there is none.
ValueRange finite_extent(std::span<const double> values);

/// The extent without what a few values do: where the hundredth of the values at both ends takes more than a
/// third of the whole extent, that of the others. Such as one spot at a corner, or a particle that flies.
ValueRange robust_extent(std::span<const double> values);

/// Of the extents of several runs, what most of them need: where there are three or more, those more than
/// half as wide again as the median one do not count. low > high if there is none.
ValueRange usual_extent(std::span<const ValueRange> extents);

/// The extent widened to round numbers, about a twentieth of it coarse, so that it ends on ticks.
/// Values that are all equal get an interval around them; an empty extent becomes 0 to 1.
ValueRange rounded_range(ValueRange extent);

/// As rounded_range, and with zero in the middle (for diverging colour maps).
ValueRange centred_range(ValueRange extent);

}  // namespace porosph::render
