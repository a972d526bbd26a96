// The linear system of the effective-stress equilibrium on 15-node triangles.
//
// Balance of the mixture: div(sigma' + p_w I) + rho g = 0, and on the free outline the outside water presses
// with the pore pressure of the surface: (sigma' + p_w I) n = p_w n, so sigma' n = 0 there. For every virtual
// displacement v
//
//   int sigma' : eps(v) = int rho g . v - int p_w div v + oint p_w n . v.
//
// Where p_w is continuous the last two terms are int grad p_w . v, the buoyancy of eq. (22); written as above
// a jump of the water level from one stretch to the next presses on the soil there as well.
#pragma once

#include <Eigen/SparseCore>

#include "solver/reference/fem/constraints.hpp"
#include "solver/reference/fem/triangle_water.hpp"

namespace porosph {

struct LinearSystem {
  Eigen::SparseMatrix<double> stiffness;  ///< lower triangle only, per metre of width [N/m2]
  Eigen::VectorXd load;                   ///< per metre of width [N/m]
};

/// One unknown per free direction of a node, as `freedoms` numbers them.
LinearSystem assemble(const Case&, const Mesh&, const P4Mesh&, const MeshWater& water, const Freedoms&);

/// The constant matrix G with d f/d(x, y) = G * d f/d(l1, l2) in the triangle a, b, c [1/m].
Eigen::Matrix2d gradient_map(const Point& a, const Point& b, const Point& c);

}  // namespace porosph
