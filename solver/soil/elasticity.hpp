// Isotropic elasticity of the soil skeleton with the Jaumann rate, eqs. (26)-(31).
#pragma once

#include "solver/tensor.hpp"

namespace porosph {

struct Elasticity {
  double shear_modulus = 0;  ///< G [Pa]
  double bulk_modulus = 0;   ///< K [Pa]

  static Elasticity from_young(double youngs_modulus, double poissons_ratio) {
    return {youngs_modulus / (2 * (1 + poissons_ratio)), youngs_modulus / (3 * (1 - 2 * poissons_ratio))};
  }

  /// M = K + 4 G / 3, modulus of one-dimensional compression [Pa].
  double constrained_modulus() const { return bulk_modulus + 4 * shear_modulus / 3; }

  /// Effective stress rate of eq. (28) for the strain rate D, the symmetric part of the velocity gradient
  /// [Pa/s]; the rotation terms of eq. (30) come apart.
  Stress elastic_rate(const Gradient& velocity_gradient) const {
    const double lambda = bulk_modulus - 2 * shear_modulus / 3, g2 = 2 * shear_modulus;
    const double pressure_rate = lambda * velocity_gradient.trace();
    return {pressure_rate + g2 * velocity_gradient.xx, pressure_rate + g2 * velocity_gradient.yy,
            pressure_rate, shear_modulus * (velocity_gradient.xy + velocity_gradient.yx)};
  }

  /// Effective stress after a step dt [s] with the velocity gradient dv_i/dx_j at the middle of the step
  /// [1/s]: the old stress turned by the step's rotation (Hughes and Winget 1980: exact for a rigid
  /// rotation), plus eq. (28).
  Stress elastic_step(const Stress& old, const Gradient& velocity_gradient, double dt) const {
    const double spin = 0.5 * (velocity_gradient.yx - velocity_gradient.xy);  // omega_yx of eq. (31)
    return turned(old, 0.5 * spin * dt) + elastic_rate(velocity_gradient) * dt;
  }

  /// Elastic energy per volume, s : s / 4 G + p^2 / 2 K [J/m3].
  double stored_energy(const Stress& s) const {
    const double mean = s.mean();
    const double xx = s.xx - mean, yy = s.yy - mean, zz = s.zz - mean;
    const double deviatoric = xx * xx + yy * yy + zz * zz + 2 * s.xy * s.xy;
    return deviatoric / (4 * shear_modulus) + mean * mean / (2 * bulk_modulus);
  }

  /// Stress turned counter-clockwise by the angle whose half has the tangent t.
  static Stress turned(const Stress& s, double t) {
    const double scale = 1 / (1 + t * t), c = (1 - t * t) * scale, sn = 2 * t * scale;
    const double shear = 2 * c * sn * s.xy;
    return {c * c * s.xx + sn * sn * s.yy - shear, sn * sn * s.xx + c * c * s.yy + shear, s.zz,
            c * sn * (s.xx - s.yy) + (c * c - sn * sn) * s.xy};
  }
};

}  // namespace porosph
