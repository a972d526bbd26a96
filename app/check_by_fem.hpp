// A run held against finite elements of its own case, by itself.
#pragma once

#include <optional>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph::app {

/// Throws std::runtime_error that says why, where the case asks for finite elements that are not possible.
void require_fem(const Case& scene);

/// What a run of the case will do about it: for `porosph check`. Needs a case that require_fem() accepts.
std::string fem_outlook(const Case& scene);

/// For a run that is over: `outcome` has its status, stepping_seconds and unbalanced_force_ratio. Where the
/// case leaves it to the program, what prevents the comparison is stated in FemCheck::skipped.
FemCheck check_by_fem(Simulation& simulation, const Summary& outcome);

/// A line for each soil, and why nothing was compared.
std::string tell(const FemCheck& check);

}  // namespace porosph::app
