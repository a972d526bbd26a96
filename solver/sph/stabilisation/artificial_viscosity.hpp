// Pairwise artificial viscosity (Monaghan 1992; Bui, Fukagawa, Sako and Ohno 2008), part of C_ab in eqs.
// (14)-(25).
#pragma once

#include <algorithm>

namespace porosph {

struct ArtificialViscosity {
  double alpha = 0, beta = 0;  ///< linear and quadratic strength [-]

  bool active() const { return alpha != 0 || beta != 0; }

  /// Pi_ab [Pa m6/kg2]: positive for approaching pairs, else zero. `vx` = v_ab . x_ab [m2/s], `r2` = |x_ab|^2
  /// [m2], `c` and `rho` are the pair's means of sound speed (eq. 16) and density.
  double pair(double vx, double r2, double h, double c, double rho) const {
    const double phi = h * std::min(vx, 0.0) / (r2 + 0.01 * h * h);
    return (-alpha * c * phi + beta * phi * phi) / rho;
  }
};

}  // namespace porosph
