// Isotropic elasticity of the soil skeleton with the Jaumann rate, eqs. (26)-(31).
#pragma once

#include "solver/soil/rotation.hpp"
#include "solver/space/tensor.hpp"

namespace porosph {

/// Part of the opening that the volume strain of a step closes.
inline double closing(double opening, double volume_strain) {
  const double compression = volume_strain < 0 ? -volume_strain : 0;
  return opening < compression ? opening : compression;
}

struct Elasticity {
  double shear_modulus = 0;  ///< G [Pa]
  double bulk_modulus = 0;   ///< K [Pa]

  static Elasticity from_young(double youngs_modulus, double poissons_ratio) {
    return {youngs_modulus / (2 * (1 + poissons_ratio)), youngs_modulus / (3 * (1 - 2 * poissons_ratio))};
  }

  /// M = K + 4 G / 3, modulus of one-dimensional compression [Pa].
  double constrained_modulus() const { return bulk_modulus + 4 * shear_modulus / 3; }
  /// The same at any state.
  template <class Space, class History>
  double constrained_modulus(const Symmetric<Space>&, const History&) const {
    return constrained_modulus();
  }

  /// Effective stress rate of eq. (28) for the strain rate D, the symmetric part of the velocity gradient
  /// [Pa/s]; the rotation terms of eq. (30) come apart.
  Stress elastic_rate(const Gradient& g) const {
    const double pressure_rate = lambda() * g.trace(), g2 = 2 * shear_modulus;
    return {pressure_rate + g2 * g.xx, pressure_rate + g2 * g.yy, pressure_rate,
            shear_modulus * (g.xy + g.yx)};
  }
  Symmetric<Axisymmetric> elastic_rate(const GradientIn<Axisymmetric>& g) const {
    const double pressure_rate = lambda() * g.trace(), g2 = 2 * shear_modulus;
    return {pressure_rate + g2 * g.xx, pressure_rate + g2 * g.yy, pressure_rate + g2 * g.zz,
            shear_modulus * (g.xy + g.yx)};
  }
  Symmetric<Solid> elastic_rate(const GradientIn<Solid>& g) const {
    const double pressure_rate = lambda() * g.trace(), g2 = 2 * shear_modulus;
    return {pressure_rate + g2 * g.xx,     pressure_rate + g2 * g.yy,     pressure_rate + g2 * g.zz,
            shear_modulus * (g.xy + g.yx), shear_modulus * (g.yz + g.zy), shear_modulus * (g.xz + g.zx)};
  }

  /// Effective stress after a step dt [s] with the velocity gradient dv_i/dx_j at the middle of the step
  /// [1/s]: the old stress turned by the step's rotation, plus eq. (28).
  template <class Space>
  Symmetric<Space> elastic_step(const Symmetric<Space>& old, const GradientIn<Space>& velocity_gradient,
                                double dt) const {
    return turned(old, velocity_gradient, dt) + elastic_rate(velocity_gradient) * dt;
  }

  /// An elastic step of soil in which an opening, as a volume strain, has to close before mean stress
  /// returns: the stress, and how much of it the step has shut.
  template <class Space>
  struct ClosingStep {
    Symmetric<Space> stress;
    double shut;
  };
  template <class Space>
  [[gnu::always_inline]] ClosingStep<Space> closing_step(const Symmetric<Space>& old,
                                                         const GradientIn<Space>& velocity_gradient,
                                                         double dt, double opening) const {
    const double shut = closing(opening, velocity_gradient.trace() * dt);
    return {elastic_step(old, velocity_gradient, dt).plus_isotropic(bulk_modulus * shut), shut};
  }

  /// Elastic energy per volume, s : s / 4 G + p^2 / 2 K [J/m3].
  template <class Space>
  double stored_energy(const Symmetric<Space>& stress) const {
    const double mean = stress.mean();
    return stress.plus_isotropic(-mean).squared() / (4 * shear_modulus) + mean * mean / (2 * bulk_modulus);
  }

 private:
  double lambda() const { return bulk_modulus - 2 * shear_modulus / 3; }
};

}  // namespace porosph
