// Warnings before a run starts.
#pragma once

#include <string>
#include <vector>

#include "solver/simulation/simulation.hpp"

namespace porosph::app {

/// What the case alone tells: settings that are known to fail, values that can hardly be meant.
std::vector<std::string> warnings_of(const Case& scene);

/// What its particles tell besides: a lattice that misses the drawn volume, water that wets no particle.
std::vector<std::string> warnings_of(const Model& model, const Case& scene);

/// Says them on standard error.
void warn(const std::vector<std::string>& warnings);

/// Says on standard error where steps are smaller than the case asks for.
void warn_of_smaller_steps(const Simulation& simulation);

}  // namespace porosph::app
