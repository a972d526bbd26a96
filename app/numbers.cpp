#include "app/numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "app/command.hpp"

namespace porosph::app {

double read_number(const std::string& option, const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw UsageError(fmt::format("{}: '{}' is not a number", option, text));
  return value;
}

}  // namespace porosph::app
