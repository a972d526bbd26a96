#include "app/range.hpp"

#include <fmt/format.h>

#include "app/command.hpp"
#include "app/numbers.hpp"

namespace porosph::app {

std::optional<render::ValueRange> read_range(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto comma = text.find(',');
  if (comma == std::string::npos) throw UsageError(fmt::format("{} = {}: must be LOW,HIGH", option, text));
  const render::ValueRange range{read_number(option, text.substr(0, comma)),
                                 read_number(option, text.substr(comma + 1))};
  if (range.low >= range.high) throw UsageError(fmt::format("{} = {}: LOW must be below HIGH", option, text));
  return range;
}

}  // namespace porosph::app
