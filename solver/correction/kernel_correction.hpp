// Kernel-gradient correction, eqs. (9) and (10).
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/tensor.hpp"

namespace porosph {

/// L where the neighbours hardly span the plane (a lone particle, a row, a thin toe). `sum` is symmetric; its
/// eigenvalues e become 1 / e, but e / least^2 below `least`: with the support the stiffness goes to zero,
/// which is e L^2 and bounds the stable time step.
inline Mat2 limited_correction(const Mat2& sum, double least) {
  const auto limited = [least](double e) { return e > least ? 1 / e : e / (least * least); };
  const double mean = 0.5 * (sum(0, 0) + sum(1, 1)), half = 0.5 * (sum(0, 0) - sum(1, 1));
  const double radius = std::hypot(half, sum(0, 1));
  const double along = limited(mean + radius), across = limited(mean - radius);
  if (radius == 0) return Mat2(along * Mat2::Identity());
  const Mat2 direction = (Mat2() << half, sum(0, 1), sum(1, 0), -half).finished() / radius;
  return Mat2(0.5 * (along + across) * Mat2::Identity() + 0.5 * (along - across) * direction);
}

/// L of eq. (10) from its sum, sum_b V_b grad_a W_ab (x) (x_b - x_a). (The paper prints x_a - x_b, which
/// would turn the sign of every gradient; the test is that a linear field's gradient comes out exact.)
inline Mat2 correction_matrix(const Mat2& sum) {
  constexpr double spans_the_plane = 0.15,
                   least = 0.1;  // inside det is 1, in a right-angled corner about 1/4
  return sum.determinant() > spans_the_plane ? inverse(sum) : limited_correction(sum, least);
}

}  // namespace porosph
