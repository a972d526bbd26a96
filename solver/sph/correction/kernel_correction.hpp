// Kernel-gradient correction, eqs. (9) and (10).
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "solver/space/tensor.hpp"

namespace porosph {

/// L where the neighbours hardly span the plane (a lone particle, a row, a thin toe): the inverse of `sum`, a
/// symmetric matrix, whose eigenvalues below `least` are taken as that. No gradient grows by more than
/// 1 / least, which bounds the stiffness and with it the stable time step.
inline Mat2 limited_correction(const Mat2& sum, double least) {
  const double mean = 0.5 * (sum(0, 0) + sum(1, 1)), half = 0.5 * (sum(0, 0) - sum(1, 1));
  const double radius = std::hypot(half, sum(0, 1));
  const double large = 1 / std::max(mean + radius, least), small = 1 / std::max(mean - radius, least);
  if (radius == 0) return Mat2(large * Mat2::Identity());
  const Mat2 direction = (Mat2() << half, sum(0, 1), sum(1, 0), -half).finished() / radius;
  return Mat2(0.5 * (large + small) * Mat2::Identity() + 0.5 * (large - small) * direction);
}

/// L of eq. (10) from its sum, sum_b V_b grad_a W_ab (x) (x_b - x_a). (The paper prints x_a - x_b, which
/// would turn the sign of every gradient; the test is that a linear field's gradient comes out exact.) Exact
/// where the sum's determinant, which is 1 inside and about 1/4 in a right-angled corner, exceeds
/// `spans_the_plane`.
inline Mat2 correction_matrix(const Mat2& sum, double spans_the_plane = 0.15) {
  // Two particles alone (trace 0.25) with an exact gradient along their line would swing faster than a
  // lattice.
  const double least = sum.trace() < 0.5 ? 0.3 : 0.1;
  return sum.determinant() > spans_the_plane ? inverse(sum) : limited_correction(sum, least);
}

/// The same in space, where a right-angled corner has 1/8: the limit is the same share of it.
inline Mat3 correction_matrix(const Mat3& sum, double spans_the_space = 0.075) {
  if (sum.determinant() > spans_the_space) return sum.inverse();
  const double least = sum.trace() < 0.75 ? 0.3 : 0.1;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(0.5 * (sum + sum.transpose()));
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
         axes.eigenvectors().transpose();
}

}  // namespace porosph
