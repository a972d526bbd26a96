// Linear elastic soil without cohesion: it bears no mean tension, and closes before it bears again.
#pragma once

#include "solver/soil/elasticity.hpp"
#include "solver/soil/law.hpp"
#include "solver/soil/law_fields.hpp"

namespace porosph {

/// Where the mean effective stress would be tensile, no stress is left (the apex of a cohesionless cone), and
/// the law remembers by how much the soil has come apart. Compression closes that before stress returns, so
/// that soil as loose as when it was thrown off carries none. Shear strength is unlimited elsewhere.
struct NoTension : Elasticity {
  struct History {
    double opening = 0;
  };
  static constexpr std::array<Field, 1> history{law_fields::opening};

  static NoTension from_young(double youngs_modulus, double poissons_ratio) {
    return {Elasticity::from_young(youngs_modulus, poissons_ratio)};
  }

  template <class Space>
  [[gnu::always_inline]] Symmetric<Space> step(const Symmetric<Space>& old,
                                               const GradientIn<Space>& velocity_gradient, double dt,
                                               History& q) const {
    const auto [trial, shut] = closing_step(old, velocity_gradient, dt, q.opening);
    const double mean = trial.mean(), tension = mean > 0 ? mean : 0;
    q.opening += tension / bulk_modulus - shut;
    return trial * (q.opening > 0 ? 0.0 : 1.0);
  }
};
static_assert(SoilLaw<NoTension>);

}  // namespace porosph
