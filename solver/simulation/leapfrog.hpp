// Leapfrog integration with the damping of eqs. (32)-(34).
#pragma once

#include "solver/tensor.hpp"

namespace porosph {

/// v^{n+1/2} from v^{n-1/2}, the acceleration a^n and the damping c_d [1/s], which acts on their mean (second
/// order).
inline Vec2 kick(const Vec2& velocity, const Vec2& acceleration, double damping, double dt) {
  const double half = 0.5 * damping * dt;
  return ((1 - half) * velocity + dt * acceleration) / (1 + half);
}

/// v^n, from v^{n-1/2}: half a kick, damping included.
inline Vec2 half_kick(const Vec2& velocity, const Vec2& acceleration, double damping, double dt) {
  return (velocity + 0.5 * dt * acceleration) / (1 + 0.5 * damping * dt);
}

/// v^{1/2} from v^0.
inline Vec2 first_kick(const Vec2& velocity, const Vec2& acceleration, double damping, double dt) {
  return velocity + 0.5 * dt * (acceleration - damping * velocity);
}

}  // namespace porosph
