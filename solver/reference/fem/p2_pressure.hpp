// Quadratic pore pressure on the 15-node triangles of the displacements: one degree of strain less one, so
// that the pair has no pressure without a displacement that feels it (Taylor and Hood 1973; Boffi, Brezzi and
// Fortin, Mixed Finite Element Methods, 8.8).
#pragma once

#include "solver/reference/fem/p4_triangle.hpp"

namespace porosph::p2 {

inline constexpr int node_count = 6;

/// Vertices 0 1 2, then the middles of the edges 0-1, 1-2, 2-0, as places in p4::nodes().
inline constexpr std::array<int, node_count> in_p4{0, 1, 2, 4, 7, 10};

using Values = Eigen::Matrix<double, node_count, 1>;
using Gradients = Eigen::Matrix<double, 2, node_count>;  ///< d/d(l1, l2), with l0 = 1 - l1 - l2

Values values(const p4::Barycentric& at);
Gradients gradients(const p4::Barycentric& at);

}  // namespace porosph::p2
