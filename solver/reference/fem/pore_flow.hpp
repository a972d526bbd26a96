// What saturated soil's water adds to the equations of the 15-node triangles: the volume that displacements
// open for it, what it gives by its own compression, and Darcy's flow.
#pragma once

#include <Eigen/SparseCore>

#include "solver/reference/fem/constraints.hpp"
#include "solver/reference/fem/p2_pressure.hpp"

namespace porosph {

/// With u the unknowns of the displacement and h the excess head at the nodes of the pressure, per metre of
/// width,
///
///   W = C^T u + S h,      dW/dt = q - H h,
///
/// W being the water that the shape functions' parts of the soil have gained [m2].
struct PoreFlow {
  std::vector<int> nodes;                                  ///< of the pressure, among those of the P4 mesh
  std::vector<std::array<int, p2::node_count>> triangles;  ///< places in `nodes`
  Eigen::SparseMatrix<double> opening;                     ///< C [m]
  Eigen::SparseMatrix<double> storage;                     ///< S [m]
  Eigen::SparseMatrix<double> conductivity;                ///< H [m/s]
  Eigen::SparseMatrix<double> softness;  ///< as S with 1/M of the soil: what it would give, drained [m]
  Eigen::VectorXd inflow;                ///< q through faces with a rate [m2/s]
  std::vector<double> given;             ///< h at faces with a head [m]; not a number elsewhere
};

/// Of a case whose water is coupled or undrained.
PoreFlow assemble_pore_flow(const Case&, const Mesh&, const P4Mesh&, const Freedoms&);

}  // namespace porosph
