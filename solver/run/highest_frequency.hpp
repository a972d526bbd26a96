// The fastest vibration that a scene's particles can make: it sets the largest stable time step.
#pragma once

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/run/scaled_inertia.hpp"

namespace porosph {

/// Of the linear elastic particles where they are, with their scaled inertia and without viscosity [rad/s]:
/// power iteration with the case's own dynamics on a copy of the model. At most a few percent too low.
double highest_frequency(const FormulationCase& formulation, Model model, const ScaledInertia& inertia = {});

}  // namespace porosph
