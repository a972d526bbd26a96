// What --help says of the fields that can be drawn.
#pragma once

#include <string>

namespace porosph::app {

/// Names the fields that files have and those that are computed when they are drawn.
std::string field_help();

}  // namespace porosph::app
