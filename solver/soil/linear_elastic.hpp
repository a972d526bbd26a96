// Linear elastic soil.
#pragma once

#include "solver/soil/elasticity.hpp"
#include "solver/soil/law.hpp"

namespace porosph {

/// Isotropic linear elasticity, in compression and tension.
struct LinearElastic : Elasticity {
  using History = NoHistory;
  static constexpr std::array<Field, 0> history{};

  static LinearElastic from_young(double youngs_modulus, double poissons_ratio) {
    return {Elasticity::from_young(youngs_modulus, poissons_ratio)};
  }

  template <class Space>
  Symmetric<Space> step(const Symmetric<Space>& old, const GradientIn<Space>& velocity_gradient, double dt,
                        History&) const {
    return elastic_step(old, velocity_gradient, dt);
  }
};
static_assert(SoilLaw<LinearElastic>);

}  // namespace porosph
