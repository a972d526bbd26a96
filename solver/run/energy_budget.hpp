// Where the energy went that gravity released in soil that flows.
#pragma once

#include <optional>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// Since the start, at which the total energy was `at_start` [J/m], or since the soil lost its equilibrium in
/// a flow. Nothing where no soil yields, where damping takes energy, or while soil rests.
std::optional<Summary::EnergyBudget> energy_budget(Simulation& simulation, double at_start);

/// All parts as they count now, of which those of an earlier state are to be subtracted; of soil that yields.
Summary::EnergyBudget energy_counts(Simulation& simulation);

}  // namespace porosph
