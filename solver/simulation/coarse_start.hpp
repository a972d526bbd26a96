// A start from what a run with fewer particles came to.
#pragma once

#include "solver/simulation/simulation.hpp"

namespace porosph {

/// Runs the same case at twice the spacing to rest (itself from a coarser start, as often as the case says)
/// and gives the particles of `simulation`, which must not have stepped yet, its displacements, interpolated
/// by moving least squares, and the stress that belongs to them, at rest. Throws std::runtime_error where the
/// coarse run is unstable.
void start_from_coarse(Simulation& simulation);

}  // namespace porosph
