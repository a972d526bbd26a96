// Steps as the integrator takes them, for tests that hold a Dynamics and its model in hand.
#pragma once

#include <vector>

#include "solver/sph/dynamics.hpp"

namespace porosph {

/// Of the model as it is now.
inline std::vector<Vec2> accelerations_of(Dynamics& dynamics, const Model& model) {
  std::vector<Vec2> a(model.particles.size());
  dynamics.prepare();
  dynamics.accelerations(a);
  return a;
}
inline std::vector<Mat2> velocity_gradients_of(Dynamics& dynamics, const Model& model) {
  std::vector<Mat2> g(model.particles.size());
  dynamics.prepare();
  dynamics.velocity_gradients(g);
  return g;
}

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
    if (model.water.present()) model.pore_water->follow(model.water, p, 0, p.size());
    dynamics.strain(dt);
  }
}

}  // namespace porosph
