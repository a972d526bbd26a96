// From what a case says of a soil to its law.
#pragma once

#include "solver/model/model.hpp"

namespace porosph {

/// The law of a soil in a scene of this spacing [m], which softening is scaled with. Its strength is divided
/// by `reduction`: c and tan(phi), peak and residual, c_u, and tension; psi is at most the reduced phi;
/// so is M of Cam-clay by its angle, whose preconsolidation stays.
AnyLaw soil_law(const SoilCase& soil, double spacing, double reduction = 1);

/// Gives the soils of a model the strength of its case, divided by `factor`. What particles remember stays.
void reduce_strength(Model& model, const Case& scene, double factor);

}  // namespace porosph
