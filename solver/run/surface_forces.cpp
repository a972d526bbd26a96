#include "solver/run/surface_forces.hpp"

#include "solver/boundary/load.hpp"

namespace porosph {

void SurfaceForces::press(const Model& model, double time, std::span<Vec2> accelerations) const {
  add_loads(model.loads, model.particles, time, accelerations);
  add_surface_loads(loads, model.particles, time, accelerations);
}

void SurfaceForces::hold(const Particles& particles, Kick kick, double dt, double then,
                         std::span<Vec2> accelerations) {
  for (Footing& footing : footings) footing.hold(particles, kick, dt, then, accelerations);
}

double SurfaceForces::squares(double time) const {
  double sum = load_squares(loads, time);
  for (const Footing& footing : footings) sum += footing.squares();
  return sum;
}

SurfaceForces surface_forces(const Case& scene, const Model& model) {
  return {surface_loads(scene, model), make_footings(scene, model)};
}

}  // namespace porosph
