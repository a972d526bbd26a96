// The particles behind the walls, for looking at.
#pragma once

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// The mirror particles of the walls at the present instant: BoundaryId (number of the boundary in the case),
/// Fixed (1 or, of a roller, 0) and ParticleId of the soil particle that each stems from. Those of fixed
/// walls follow the soil in the consistent form; in the paper's forms they stay where they were at t = 0.
Frame make_boundary_frame(const Simulation& simulation);

}  // namespace porosph
