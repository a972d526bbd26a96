// What engineers read from a stress tensor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/space/tensor.hpp"

namespace porosph {

/// Principal stresses, the largest (most tensile) first [Pa].
inline std::array<double, 3> principal_stresses(const Stress& s) {
  const double middle = 0.5 * (s.xx + s.yy), radius = std::hypot(0.5 * (s.xx - s.yy), s.xy);
  std::array<double, 3> principal = {middle + radius, middle - radius, s.zz};
  std::sort(principal.begin(), principal.end(), std::greater<>());
  return principal;
}

/// s = sigma - tr(sigma) / 3 I [Pa].
inline Stress deviator(const Stress& s) {
  const double mean = s.mean();
  return {s.xx - mean, s.yy - mean, s.zz - mean, s.xy};
}

/// sqrt(3/2 s : s) [Pa]; in triaxial compression the deviatoric stress q.
inline double von_mises_stress(const Stress& stress) {
  const Stress s = deviator(stress);
  return std::sqrt(1.5 * (s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2 * s.xy * s.xy));
}

}  // namespace porosph
