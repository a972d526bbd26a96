// The 15-node triangle: complete polynomials of degree 4 on straight-sided triangles.
// Source: Silvester 1969, Int. J. Engng Sci. 7 (shape functions); Dunavant 1985, IJNME 21 (quadrature).
#pragma once

#include <Eigen/Core>
#include <array>

namespace porosph::p4 {

inline constexpr int order = 4;
inline constexpr int node_count = 15;

using Barycentric = Eigen::Vector3d;  ///< (l0, l1, l2), sum 1; l_i is 1 at vertex i
using Values = Eigen::Matrix<double, node_count, 1>;
using Gradients = Eigen::Matrix<double, 2, node_count>;  ///< d/d(l1, l2), with l0 = 1 - l1 - l2

/// Where the nodes are, equally spaced: vertices 0 1 2; then three on each of the edges 0-1, 1-2 and 2-0, in
/// that direction; then the inner ones next to vertices 0, 1, 2. This is also VTK's order for Lagrange
/// triangles.
const std::array<Barycentric, node_count>& nodes();

/// The shape functions' values at a point; function i is 1 at node i and 0 at the others.
Values values(const Barycentric& at);

/// The shape functions' derivatives with respect to (l1, l2) at a point.
Gradients gradients(const Barycentric& at);

struct QuadraturePoint {
  Barycentric at;
  double weight;  ///< the weights sum to 1: times the area gives the integral
};

/// Exact for degree 6, the product of two gradients.
const std::array<QuadraturePoint, 12>& quadrature();

}  // namespace porosph::p4
