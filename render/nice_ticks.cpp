#include "render/nice_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace porosph::render {

namespace {

constexpr double slack = 1e-9;  // relative to the step: a bound that is a tick but for rounding counts

std::string superscript(int number) {
  static const std::string digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
  return text;
}

std::string power_of_ten(int exponent) { return "10" + superscript(exponent); }

std::string with_true_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

int exponent_of(double number) { return static_cast<int>(std::floor(std::log10(number) + slack)); }

std::string plain_label(double tick) { return fmt::format("{:.{}f}", tick, std::max(0, -exponent_of(tick))); }

std::string power_label(double tick) {
  const int exponent = exponent_of(tick);
  const double mantissa = std::round(tick / std::pow(10., exponent));
  return mantissa == 1 ? power_of_ten(exponent) : fmt::format("{:.0f}×{}", mantissa, power_of_ten(exponent));
}

int decimals_of(double step) { return std::max(0, -exponent_of(step)); }

std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> ticks;
  const double first = std::ceil(low / step - slack), last = std::floor(high / step + slack);
  for (double n = first; n <= last; n += 1) ticks.push_back(n == 0 ? 0 : n * step);
  return ticks;
}

}  // namespace

double nice_step(double step) {
  const double power = std::pow(10., std::floor(std::log10(step)));
  for (const double mantissa : {1., 2., 5.})
    if (step <= mantissa * power * (1 + slack)) return mantissa * power;
  return 10 * power;
}

std::vector<double> linear_ticks(double low, double high, int max_count) {
  if (!(high > low)) return {low};
  const std::size_t most = std::max(max_count, 1);
  double step = nice_step(0.5 * (high - low) / static_cast<double>(most));
  std::vector<double> ticks = multiples(step, low, high), finer;
  while (ticks.size() > most) {
    finer = std::move(ticks);
    step = nice_step(1.01 * step);
    ticks = multiples(step, low, high);
  }
  if (ticks.empty() && !finer.empty()) ticks = {finer.front()};
  return ticks;
}

LogTicks log_ticks(double low, double high, int max_count) {
  const int first = static_cast<int>(std::ceil(std::log10(low) - slack));
  const int last = static_cast<int>(std::floor(std::log10(high) + slack));
  const int decades = std::max(last - first + 1, 0);
  const int stride = std::max(1, (decades + max_count - 1) / std::max(max_count, 1));
  const auto inside = [&](double tick) { return tick >= low * (1 - slack) && tick <= high * (1 + slack); };

  LogTicks ticks;
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa < 10; ++mantissa) {
      const double tick = mantissa * std::pow(10., exponent);
      if (!inside(tick)) continue;
      const bool power = mantissa == 1 && (exponent - first) % stride == 0;
      const bool extra = decades < 3 && 3 * decades <= max_count && (mantissa == 2 || mantissa == 5);
      if (power || extra)
        ticks.major.push_back(tick);
      else if (stride == 1 || mantissa == 1)
        ticks.minor.push_back(tick);
    }
  }
  return ticks;
}

TickLabels linear_tick_labels(const std::vector<double>& ticks) {
  double largest = 0, step = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    largest = std::max(largest, std::abs(ticks[i]));
    if (i > 0 && (step == 0 || ticks[i] - ticks[i - 1] < step)) step = ticks[i] - ticks[i - 1];
  }
  if (step == 0) step = largest > 0 ? 1e-3 * largest : 1;

  TickLabels result;
  const int exponent = largest > 0 ? exponent_of(largest) : 0;
  const bool scaled = exponent >= 5 || exponent <= -3;
  const double factor = scaled ? std::pow(10., exponent) : 1;
  if (scaled) result.factor = "×" + power_of_ten(exponent), result.unit = factor;
  const int decimals = decimals_of(step / factor);
  for (const double tick : ticks)
    result.labels.push_back(with_true_minus(fmt::format("{:.{}f}", tick / factor, decimals)));
  return result;
}

std::vector<std::string> log_tick_labels(const std::vector<double>& ticks) {
  const bool plain =
      std::ranges::all_of(ticks, [](double tick) { return tick > 0.999e-3 && tick < 1.001e4; });
  std::vector<std::string> labels;
  for (const double tick : ticks) labels.push_back(plain ? plain_label(tick) : power_label(tick));
  return labels;
}

}  // namespace porosph::render
