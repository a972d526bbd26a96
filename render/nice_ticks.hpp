// Round positions and labels for axes and colour bars.
#pragma once

#include <string>
#include <vector>

namespace porosph::render {

/// Smallest of 1, 2, 5 times a power of ten that is not below `step` (> 0).
double nice_step(double step);

/// Multiples of the finest nice step of which at most `max_count` (>= 1) lie within [low, high]; never none.
std::vector<double> linear_ticks(double low, double high, int max_count);

struct LogTicks {
  std::vector<double> major;  ///< labelled
  std::vector<double> minor;  ///< marks only
};
/// Powers of ten within [low, high] (both > 0), thinned to `max_count`; with fewer than two, also 2 and 5
/// times them.
LogTicks log_ticks(double low, double high, int max_count);

struct TickLabels {
  std::vector<std::string> labels;  ///< one per tick, the same number of decimals for all
  std::string factor;               ///< common factor such as "×10⁻⁵", empty where none is needed
  double unit = 1;                  ///< that factor
};
TickLabels linear_tick_labels(const std::vector<double>& ticks);

/// Plain decimals if all ticks lie within 0.001 to 10000, else powers of ten such as 10⁻⁵ or 2×10⁻⁵.
std::vector<std::string> log_tick_labels(const std::vector<double>& ticks);

}  // namespace porosph::render
