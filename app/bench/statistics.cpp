#include "app/bench/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace porosph::bench {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("the spread of no values");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

std::string text(const Spread& s) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", s.median, s.low, s.high);
}

}  // namespace porosph::bench
