// Warnings before a run starts.
#pragma once

#include <fmt/format.h>

#include <iostream>

#include "solver/case/known_limits.hpp"

namespace porosph::app {

/// Says on standard error which settings are known to fail.
inline void warn_of_known_failures(const Case& scene) {
  for (const std::string& text : known_failures(scene)) std::cerr << "porosph: warning: " << text << '\n';
}

}  // namespace porosph::app
