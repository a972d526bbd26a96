// Round positions and labels for axes and colour bars.
#pragma once

#include <string>
#include <vector>

namespace porosph {

/// Smallest of 1, 2, 5 times a power of ten that is not below `step` (> 0).
double nice_step(double step);

/// Multiples of a nice step within [low, high], at most `max_count` of them (at least 2 unless low == high).
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
};
TickLabels linear_tick_labels(const std::vector<double>& ticks);

/// 0.01 to 1000 in plain decimals, other powers of ten as 10⁻⁵, other numbers as 2×10⁻⁵.
std::string log_tick_label(double tick);

}  // namespace porosph
