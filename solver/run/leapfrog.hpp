// Leapfrog integration with the damping of eqs. (32)-(34).
#pragma once

#include "solver/space/tensor.hpp"

namespace porosph {

/// A new velocity, keep * v + gain * a, from the old one and the acceleration.
struct Kick {
  double keep;  ///< [-]
  double gain;  ///< [s]

  Vec2 operator()(const Vec2& velocity, const Vec2& acceleration) const {
    return keep * velocity + gain * acceleration;
  }
  bool operator==(const Kick&) const = default;
};

/// To v^{n+1/2} from v^{n-1/2}, with the acceleration a^n and the damping c_d [1/s], which acts on their mean
/// (second order).
inline Kick full_kick(double damping, double dt) {
  const double half = 0.5 * damping * dt;
  return {(1 - half) / (1 + half), dt / (1 + half)};
}

/// To v^n from v^{n-1/2}.
inline Kick half_kick(double damping, double dt) {
  const double half = 0.5 * damping * dt;
  return {1 / (1 + half), 0.5 * dt / (1 + half)};
}

/// To v^{1/2} from v^0.
inline Kick first_kick(double damping, double dt) { return {1 - 0.5 * damping * dt, 0.5 * dt}; }

}  // namespace porosph
