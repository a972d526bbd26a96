// What the conventional summation of pore pressure makes of a submerged column.
#pragma once

#include "solver/reference/exact/finite_strain_column.hpp"

namespace porosph {

/// The state that eq. (17) converges to as spacing goes to zero. Summing p_a + p_b leaves out the surface
/// integral of eq. (21), the water's push on the ground: the total stress vanishes there instead of being
/// that push, and the soil carries an effective tension of gamma_w * (present depth of water above the
/// ground). Where no water stands above the ground this is the exact state. Throws std::invalid_argument, see
/// check().
FiniteStrainColumn conventional_column(const Column& column);

}  // namespace porosph
