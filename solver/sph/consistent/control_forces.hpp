// What the zero-energy control accelerates where soil flows, apart from all other forces.
#pragma once

#include <span>

#include "solver/sph/consistent/rows_at_walls.hpp"

namespace porosph {

/// The control's part of what the kernels and RowsAtWalls::leave_out() sum [m/s2], with the viscosity of each
/// particle and ghost [Pa s].
void control_forces(const ReferenceConfiguration& reference, const Particles& particles,
                    const RowsAtWalls& rows, std::span<const double> viscosity, std::span<Vec2> out);

}  // namespace porosph
