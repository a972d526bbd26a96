// Velocity gradients at the middle of a step. For the kernels only, which are compiled for each kind of
// vector units.
#pragma once

#include "solver/sph/kernels/matrices.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// rate m^-1: dv/dx from `rate`, dv over some reference, and `m`, dx at the middle of the step over the same
/// (Hughes and Winget 1980).
inline Gradient mid_step_gradient(const Gradient& rate, const Gradient& m) {
  const double scale = 1 / (m.xx * m.yy - m.xy * m.yx);
  return {(rate.xx * m.yy - rate.xy * m.yx) * scale, (rate.xy * m.xx - rate.xx * m.xy) * scale,
          (rate.yx * m.yy - rate.yy * m.yx) * scale, (rate.yy * m.xx - rate.yx * m.xy) * scale};
}
inline GradientIn<Axisymmetric> mid_step_gradient(const GradientIn<Axisymmetric>& rate,
                                                  const GradientIn<Axisymmetric>& m) {
  const Gradient g = mid_step_gradient(matrix_of(rate), matrix_of(m));
  return {g.xx, g.xy, g.yx, g.yy, rate.zz / m.zz};
}
inline GradientIn<Solid> mid_step_gradient(const GradientIn<Solid>& rate, const GradientIn<Solid>& m) {
  return product(rate, scaled(1 / determinant(m), transposed(cofactor(m))));
}

/// The same where `rate` is dv over the coordinates at the start of the step, of which `half` is a half [s].
inline Gradient step_gradient(const Gradient& rate, double half) {
  return mid_step_gradient(rate, {1 + half * rate.xx, half * rate.xy, half * rate.yx, 1 + half * rate.yy});
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
