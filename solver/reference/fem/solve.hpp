// The finite-element reference of a case: plane strain, small strain, linear elastic, effective stress,
// loaded in one step from an unstressed soil and at rest. Sources: Bathe, Finite Element Procedures, ch. 4
// (method); see assemble.hpp for the equations.
#pragma once

#include "solver/reference/fem/solution.hpp"

namespace porosph {

/// Equilibrium of the case on the mesh, which must follow its outlines, soils and water (mesh_case,
/// mesh_rectangle). SoilCase::no_tension has no effect here: where it would act, the solution is not that of
/// the case; see largest_mean_tension(). Throws std::runtime_error if the mesh does not fit, a part of the
/// soil is not held, rounding spoils the solution (stiffness contrasts well above 10^8), or
/// LoadingCase::k0_stress asks for a start under stress.
FemSolution solve_fem(const Case&, const Mesh&);

/// Largest mean effective stress (XX + YY + ZZ)/3 at a node of a soil with SoilCase::no_tension, 0 if there
/// is no such soil or it is all in compression [Pa]. Where it is not small, the reference does not hold for
/// the case.
double largest_mean_tension(const Case&, const FemSolution&);

}  // namespace porosph
