// Numbers on the command line.
#pragma once

#include <string>

namespace porosph::app {

/// A finite number and nothing else. Throws UsageError naming the option.
double read_number(const std::string& option, const std::string& text);

}  // namespace porosph::app
