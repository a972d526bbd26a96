// Biot's consolidation by finite elements: the independent answer to that on particles.
#pragma once

#include <functional>
#include <vector>

#include "solver/reference/fem/solution.hpp"

namespace porosph {

/// A case whose water is coupled or undrained, from the start to the last of `times` [s], which must ascend;
/// use(time, state) is called at each. Displacements have polynomials of degree 4, excess pressures of degree
/// 2 (p2_pressure.hpp), so that neither is spoilt by the other where no water moves.
///
/// At the time 0 the loads have just come and no water has left. From there, and from each bend in the course
/// of a load, an SDIRK method of third order (Alexander 1977, SIAM J. Numer. Anal. 14) advances in eight
/// steps for each doubling of the time since. Undrained, each time is such an instant.
///
/// Throws std::runtime_error as solve_fem() does.
void consolidate_by_fem(const Case&, const Mesh&, const std::vector<double>& times,
                        const std::function<void(double time, const FemSolution&)>& use);

}  // namespace porosph
