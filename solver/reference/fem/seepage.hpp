// Steady seepage by finite elements: the independent answer to that on particles.
#pragma once

#include <vector>

#include "solver/reference/fem/p4_mesh.hpp"

namespace porosph {

struct FemSeepage {
  std::vector<double> head;           ///< at each node [m]
  std::vector<double> pressure_head;  ///< psi there [m]
  std::vector<double> pore_pressure;  ///< p_w there, as the soil's stress feels it [Pa]
  std::vector<double> through_faces;  ///< into the soil through each of the case's faces [m2/s]
  int newton_steps = 0;
};

/// Galerkin's method with linear triangles on the nodes of the P4 mesh, 16 in each of its triangles. Their
/// stiffness is a conductance between two nodes; kr is the mean of both, and the nonlinear solver and the
/// switching of seepage faces are those of the particles (steady_seepage.hpp), which see conductances alone.
/// Throws std::runtime_error as solve_steady() does.
FemSeepage solve_fem_seepage(const Case&, const Mesh&, const P4Mesh&);

}  // namespace porosph
