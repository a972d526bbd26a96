// Artificial stress against the tensile instability (Gray, Monaghan and Swift 2001; Bui et al. 2008), part of
// C_ab.
#pragma once

#include <cmath>

#include "solver/space/tensor.hpp"

namespace porosph {

/// R_a [Pa m6/kg2]: -epsilon * sigma / rho^2 on each principal stress in tension, turned back to x, y. {xx,
/// yy, xy}.
inline Eigen::Vector3d artificial_stress(const Stress& stress, double density, double epsilon) {
  const double centre = 0.5 * (stress.xx + stress.yy), half = 0.5 * (stress.xx - stress.yy);
  const double radius = std::hypot(half, stress.xy);
  const double scale = -epsilon / (density * density);
  const double first = scale * std::max(0.0, centre + radius),
               second = scale * std::max(0.0, centre - radius);
  const double cos2 = radius > 0 ? half / radius : 1, sin2 = radius > 0 ? stress.xy / radius : 0;
  const double mean = 0.5 * (first + second), deviation = 0.5 * (first - second);
  return {mean + deviation * cos2, mean - deviation * cos2, deviation * sin2};
}

}  // namespace porosph
