// A column of elastic soil that is suddenly given its weight: vibration about the state of rest, with
// damping.
#pragma once

namespace porosph {

/// Small strains; fixed at the bottom y = 0, free at the top y = H, at rest and without stress until t = 0:
///     rho u_tt + rho c_d u_t = M u_yy - gamma'.
/// With k_n = (2n - 1) pi / (2H), omega_n = c_p k_n, and phi_n the decay of mode n from 1 at rest
/// (under-, over- or critically damped as c_d is below, above or at 2 omega_n),
///     u = u_static + sum_n 2 gamma' / (M H k_n^3) phi_n(t) sin(k_n y).
/// The series with exp(-c_d t / 2) cos(omega_n t) in place of phi_n is summed in closed form, as two
/// travelling waves (d'Alembert); the rest converges by one power of n faster. What is cut off is below 2e-8
/// (1 + c_d H / c_p) gamma' H in stress; without damping the solution has no series and is exact.
struct DynamicColumn {
  double height = 0;       ///< H [m]
  double modulus = 0;      ///< M = K + 4G/3 [Pa]
  double density = 0;      ///< rho of soil and water in it [kg/m3]
  double unit_weight = 0;  ///< gamma' = gamma_sat - gamma_w where submerged [N/m3]
  double damping = 0;      ///< c_d of eq. (33) [1/s]

  double wave_speed() const;         ///< c_p = sqrt(M / rho) [m/s]
  double period() const;             ///< of the undamped first mode, 4H / c_p [s]
  double frequency(int mode) const;  ///< omega_n of the undamped mode n = 1, 2, ... [rad/s]

  double displacement(double y, double time) const;     ///< upwards [m]
  double vertical_stress(double y, double time) const;  ///< sigma'_yy [Pa]

  /// phi_n: the solution of phi'' + c_d phi' + omega^2 phi = 0 with phi(0) = 1, phi'(0) = 0.
  static double decay(double omega, double damping, double time);
};

}  // namespace porosph
