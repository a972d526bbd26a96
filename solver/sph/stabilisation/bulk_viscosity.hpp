// Viscosity in compression, per particle: damps shocks as the pairwise artificial viscosity does.
#pragma once

#include <algorithm>

namespace porosph {

/// Viscous stress b rho c_p h tr(D) where the soil is being compressed, else zero (von Neumann and Richtmyer,
/// linear term) [Pa]. `rho_c_h` in [Pa s], `dilatation_rate` = tr(D) in [1/s].
inline double bulk_viscosity(double b, double rho_c_h, double dilatation_rate) {
  return b * rho_c_h * std::min(0.0, dilatation_rate);
}

}  // namespace porosph
