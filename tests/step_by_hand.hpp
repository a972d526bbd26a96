// Steps as the integrator takes them, for tests that hold a Dynamics and its model in hand.
#pragma once

#include <vector>

#include "solver/motion/dynamics.hpp"

namespace porosph {

/// `steps` of dt [s] from the model's velocities, undamped. Pore pressure follows the water, where there is
/// any.
inline void step_by_hand(Dynamics& dynamics, Model& model, double dt, int steps) {
  Particles& p = model.particles;
  std::vector<Vec2> acceleration(p.size());
  for (int step = 0; step < steps; ++step) {
    dynamics.prepare();
    dynamics.accelerations(acceleration);
    for (std::size_t a = 0; a < p.size(); ++a) {
      p.velocity[a] += dt * acceleration[a];
      p.position[a] += dt * p.velocity[a];
    }
    if (model.water.present()) model.water.pore_pressures(p, 0, p.size());
    dynamics.strain(dt);
  }
}

}  // namespace porosph
