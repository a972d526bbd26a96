// One particle's material step, for motion equations on the present configuration.
#pragma once

#include "solver/model/model.hpp"

namespace porosph {

/// Effective stress after a step dt [s] with the mid-step velocity gradient [1/s] (eq. 30).
inline void update_stress(Model& model, std::size_t a, const Mat2& velocity_gradient, double dt) {
  Particles& p = model.particles;
  p.stress[a] = model.soils[p.soil[a]].update(p.stress[a], velocity_gradient, dt);
}

/// Density after the step, by the continuity equation d(rho)/dt = -rho tr(D).
inline void update_density(Particles& p, std::size_t a, const Mat2& velocity_gradient, double dt) {
  const double half = 0.5 * dt * velocity_gradient.trace();
  p.density[a] *= (1 - half) / (1 + half);
}

/// Velocity gradient over the coordinates at the middle of the step, from `rate`, that over those at its
/// start [1/s] (Hughes and Winget 1980: a rigid rotation strains nothing).
inline Mat2 mid_step_gradient(const Mat2& rate, double dt) {
  return rate * inverse(Mat2(Mat2::Identity() + 0.5 * dt * rate));
}

}  // namespace porosph
