// A run at rest against finite elements, particle by particle.
#pragma once

#include "solver/output/fem_check.hpp"
#include "solver/particles/particles.hpp"
#include "solver/reference/fem/solution.hpp"

namespace porosph {

/// Effective stress and displacement of each soil at the particles' places at t = 0. Left out are particles
/// near rough_points(): five spacings around singular ones, two and a half around the others, where lines are
/// long enough for that. FemCheck::limit is 5 % and the largest strain of a soil, as finite elements of small
/// strain are off by about that themselves, and local_limit 10 % and that strain; `warnings` is left empty.
/// Throws std::runtime_error if no particle is left. What finite elements say at the case's probes is noted
/// beside it.
FemCheck compare_with_fem(const Case&, const Particles&, const FemSolution&);

/// One text for each soil and field beyond the limit, over the soil or else in a patch: how far, where, and
/// why as far as is known.
std::vector<std::string> fem_warnings(const Case&, const Particles&, const FemCheck&);

/// "sigma'_xx" and "u_y" of "EffectiveStress_XX" and "Displacement_Y".
std::string short_name(const std::string& field);

}  // namespace porosph
