// What repeated measurements say.
#pragma once

#include <string>
#include <vector>

namespace porosph::bench {

struct Spread {
  double median = 0, low = 0, high = 0;
};

/// At least one value.
Spread spread_of(std::vector<double> values);

/// "12.3 ± 3 %": the median and half the range from the lowest to the highest.
std::string text(const Spread& spread);

}  // namespace porosph::bench
