// Warnings before a run starts, and of what it has come to.
#pragma once

#include <iostream>
#include <string>
#include <vector>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph::app {

/// What the case alone tells: settings that are known to fail, values that can hardly be meant.
std::vector<std::string> warnings_of(const Case& scene);

/// What its particles tell besides: a lattice that misses the drawn volume, water that wets no particle.
std::vector<std::string> warnings_of(const Model& model, const Case& scene);

/// What the state at the end tells: soil in seepage over time that may have slid, though it rests.
std::vector<std::string> warnings_of_end(const Simulation& simulation);

/// Says them on standard error.
void warn(const std::vector<std::string>& warnings);

/// Says on standard error where a result is far from finite elements.
inline void warn_of_differences(const Summary& summary) {
  if (!summary.finite_elements) return;
  for (const std::string& text : summary.finite_elements->warnings)
    std::cerr << "porosph: warning: " << text << '\n';
}

/// Says on standard error where steps are smaller than the case asks for.
void warn_of_smaller_steps(const Simulation& simulation);

}  // namespace porosph::app
