// Linear elastic soil, optionally without tension.
#pragma once

#include "solver/soil/elasticity.hpp"
#include "solver/soil/law.hpp"

namespace porosph {

/// Isotropic linear elasticity; without tension and cohesion, no stress remains where the mean effective
/// stress would be tensile (the apex of a cohesionless cone). Shear strength is unlimited elsewhere.
struct LinearElastic : Elasticity {
  using History = NoHistory;
  static constexpr std::array<Field, 0> history{};

  bool no_tension = false;

  static LinearElastic from_young(double youngs_modulus, double poissons_ratio, bool no_tension = false) {
    return {Elasticity::from_young(youngs_modulus, poissons_ratio), no_tension};
  }

  template <class Space>
  Symmetric<Space> step(const Symmetric<Space>& old, const GradientIn<Space>& velocity_gradient, double dt,
                        History&) const {
    const Symmetric<Space> stress = elastic_step(old, velocity_gradient, dt);
    // Without cohesion there is no shear strength left either where the mean stress has gone to zero.
    return stress * (no_tension && stress.mean() > 0 ? 0.0 : 1.0);
  }
  template <class Space>
  double constrained_modulus(const Symmetric<Space>&, const History&) const {
    return Elasticity::constrained_modulus();
  }
  using Elasticity::constrained_modulus;
};
static_assert(SoilLaw<LinearElastic>);

}  // namespace porosph
