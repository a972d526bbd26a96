// Where the energy went that gravity released in soil that flows.
#pragma once

#include <optional>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// Since the start, at which the total energy was `at_start` [J/m]. Nothing where no soil yields, or
/// where damping takes energy.
std::optional<Summary::EnergyBudget> energy_budget(Simulation& simulation, double at_start);

}  // namespace porosph
