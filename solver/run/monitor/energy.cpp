#include "solver/run/monitor/energy.hpp"

#include <cmath>
#include <limits>

#include "solver/space/parallel.hpp"

namespace porosph {

double kinetic_energy(const Particles& p, std::span<const Vec2> velocity) {
  return deterministic_sum(p.size(),
                           [&](std::size_t i) { return 0.5 * p.mass[i] * velocity[i].squaredNorm(); });
}

double elastic_energy(const Model& model, std::size_t i) {
  const Particles& p = model.particles;
  return p.volume(i) * model.soils[p.soil[i]].stored_energy(p.stress[i]);
}

double elastic_energy(const Model& model) {
  return deterministic_sum(model.particles.size(), [&](std::size_t i) { return elastic_energy(model, i); });
}

double gravity_energy(const Model& model) {
  const Particles& p = model.particles;
  return -deterministic_sum(p.size(),
                            [&](std::size_t i) { return p.mass[i] * model.gravity.dot(p.displacement(i)); });
}

double water_energy(const Model& model) {
  const Particles& p = model.particles;
  return -deterministic_sum(p.size(), [&](std::size_t i) {
    const double before = model.water.pore_pressure(p.start[i].x(), p.start[i].y());
    return p.volume(i) * (p.pore_pressure[i] - before);
  });
}

double unbalanced_force_ratio(const Model& model, std::span<const Vec2> accelerations,
                              double squares_of_loads) {
  const auto squares = [&](auto&& acceleration_squared) {
    return deterministic_sum(accelerations.size(), [&](std::size_t i) {
      return model.particles.mass[i] * model.particles.mass[i] * acceleration_squared(i);
    });
  };
  const double force = squares([&](std::size_t i) { return accelerations[i].squaredNorm(); });
  const double weight = squares([&](std::size_t) { return model.gravity.squaredNorm(); }) + squares_of_loads;
  return weight > 0 ? std::sqrt(force / weight) : std::numeric_limits<double>::infinity();
}

}  // namespace porosph
