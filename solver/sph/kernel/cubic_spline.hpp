// The smoothing kernel, eq. (2).
#pragma once

#include <cmath>
#include <numbers>

namespace porosph {

/// Cubic-spline kernel of smoothing length h [m], support 2 h, normalised for 2-D and 3-D (Monaghan 1992).
template <int dim>
struct CubicSpline {
  static_assert(dim == 2 || dim == 3);
  double h;
  double alpha;  ///< normalisation [1/m^dim]

  explicit CubicSpline(double smoothing_length)
      : h(smoothing_length),
        alpha(dim == 2 ? 10.0 / (7.0 * std::numbers::pi * h * h) : 1.0 / (std::numbers::pi * h * h * h)) {}

  double support() const { return 2 * h; }

  /// W at distance r [1/m^dim].
  double value(double r) const {
    const double q = r / h, t = 2 - q;
    if (q >= 2) return 0;
    return alpha * (q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : 0.25 * t * t * t);
  }

  /// (dW/dr) / r, finite at r = 0, so that grad_a W_ab = slope(r) * (x_a - x_b) (eq. 5) [1/m^(dim + 2)].
  double slope(double r) const {
    const double q = r / h, t = q < 2 ? 2 - q : 0;
    const double inner = 2.25 * q - 3, outer = -0.75 * t * t / q;
    return alpha / (h * h) * (q < 1 ? inner : outer);
  }
};

}  // namespace porosph
