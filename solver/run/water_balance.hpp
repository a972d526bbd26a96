// What seepage over time leaves in the history: the water's balance, and what passes faces and sections.
#pragma once

#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace porosph {

/// "water.entered", "water.left" and "water.gained" since the start [m2], "<face>.inflow" of each face and
/// drain that has a name, as a mean over the last step, and "<section>.discharge" [m2/s].
std::vector<std::string> water_balance_columns(const Simulation& simulation);
std::vector<double> water_balance_row(const Simulation& simulation);

}  // namespace porosph
