// The linear system of the effective-stress equilibrium on 15-node triangles.
//
// Balance of the mixture: div(sigma' + p_w I) + rho g = 0, and on the free outline the outside water presses
// with the pore pressure of the surface: (sigma' + p_w I) n = p_w n, so sigma' n = 0 there. For every virtual
// displacement v
//
//   int sigma' : eps(v) = int rho g . v - int p_w div v + oint p_w n . v + oint t . v + sum of F s(v),
//
// t the traction of the case's loads, F the force of a footing and s(v) how far it goes into the soil.
//
// Where p_w is continuous the terms with it are int grad p_w . v, the buoyancy of eq. (22); written as above
// a jump of the water level from one stretch to the next presses on the soil there as well.
#pragma once

#include <Eigen/SparseCore>

#include "solver/reference/fem/constraints.hpp"
#include "solver/reference/fem/triangle_water.hpp"

namespace porosph {

struct LinearSystem {
  Eigen::SparseMatrix<double> stiffness;  ///< lower triangle only, per metre of width [N/m2]
  Eigen::VectorXd load;                   ///< of weight and water, per metre of width [N/m]
};

/// One unknown per free direction of a node, as `freedoms` numbers them.
LinearSystem assemble(const Case&, const Mesh&, const P4Mesh&, const MeshWater& water, const Freedoms&);

/// What the case's loads and footings add to the load at a time [s], per metre of width [N/m].
Eigen::VectorXd surface_load(const Case&, const Mesh&, const P4Mesh&, const Freedoms&, double time);

/// The corners of a triangle [m].
std::array<Point, 3> corners(const Mesh&, int triangle);

/// Each node's displacement, one column per node [m], by the unknowns.
Eigen::Matrix2Xd displacements(const Freedoms&, const Eigen::VectorXd& unknowns);

/// The constant matrix G with d f/d(x, y) = G * d f/d(l1, l2) in the triangle a, b, c [1/m].
Eigen::Matrix2d gradient_map(const Point& a, const Point& b, const Point& c);

}  // namespace porosph
