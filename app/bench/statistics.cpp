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
  const double half = 50 * (s.high - s.low) / s.median;  // of the range [%]
  return s.high > s.low ? fmt::format("{:.3g} ± {:.0f} %", s.median, half) : fmt::format("{:.3g}", s.median);
}

}  // namespace porosph::bench
