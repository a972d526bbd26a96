// Gradients of a particle's own side where soils of different stiffness meet.
#pragma once

#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// Of a body's particles in its reference configuration, whose stencils and corrections are there, with the
/// soils' elastic moduli.
OwnSides find_own_sides(const ReferenceConfiguration& reference, const Model& model);

}  // namespace porosph
