#include "solver/run/relaxed_step.hpp"

namespace porosph {

void relaxed_step(Model& model, Dynamics& dynamics, Kick kick, double dt,
                  std::span<const Vec2> accelerations) {
  Particles& p = model.particles;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    p.velocity[a] = kick(p.velocity[a], accelerations[a]);
    p.position[a] += dt * p.velocity[a];
  }
  model.pore_water->follow(model.water, p, 0, p.size());
  dynamics.strain(dt);
}

double extent_of(const Particles& p) {
  Vec2 low = p.position.front(), high = low;
  for (const Vec2& x : p.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return (high - low).maxCoeff();
}

}  // namespace porosph
