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

/// "12.3 (11.9 to 12.6)".
std::string text(const Spread& spread);

}  // namespace porosph::bench
