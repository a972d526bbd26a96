// Kernel-gradient correction, eqs. (9) and (10).
#pragma once

#include <cmath>

#include "solver/tensor.hpp"

namespace porosph {

/// L of eq. (10) from its sum, sum_b V_b grad_a W_ab (x) (x_b - x_a). (The paper prints x_a - x_b, which
/// would turn the sign of every gradient; the test is that a linear field's gradient comes out exact.) Where
/// the neighbours do not span the plane (a lone particle, a row) the gradient stays uncorrected.
inline Mat2 correction_matrix(const Mat2& sum) {
  constexpr double spans_the_plane = 1e-2;  // det of the sum is 1 inside, about 1/4 in a right-angled corner
  const double determinant = sum.determinant();
  return std::abs(determinant) > spans_the_plane ? inverse(sum) : Mat2(Mat2::Identity());
}

}  // namespace porosph
