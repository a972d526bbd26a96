// Ranges of colours on the command line.
#pragma once

#include <optional>
#include <string>

#include "render/colour_range.hpp"

namespace porosph::app {

/// "LOW,HIGH"; nothing for an empty text. Throws UsageError naming the option.
std::optional<render::ValueRange> read_range(const std::string& option, const std::string& text);

}  // namespace porosph::app
