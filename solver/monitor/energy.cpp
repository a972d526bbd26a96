#include "solver/monitor/energy.hpp"

#include <cmath>
#include <limits>

namespace porosph {

double kinetic_energy(const Particles& p, std::span<const Vec2> velocity) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += 0.5 * p.mass[i] * velocity[i].squaredNorm();
  return sum;
}

double elastic_energy(const Model& model, std::size_t i) {
  const Stress& s = model.particles.stress[i];
  const LinearElastic& soil = model.soils[model.particles.soil[i]];
  const double mean = s.mean();
  const double xx = s.xx - mean, yy = s.yy - mean, zz = s.zz - mean;
  const double deviatoric = xx * xx + yy * yy + zz * zz + 2 * s.xy * s.xy;
  return model.particles.volume(i) *
         (deviatoric / (4 * soil.shear_modulus) + mean * mean / (2 * soil.bulk_modulus));
}

double elastic_energy(const Model& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particles.size(); ++i) sum += elastic_energy(model, i);
  return sum;
}

double gravity_energy(const Model& model) {
  const Particles& p = model.particles;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum -= p.mass[i] * model.gravity.dot(p.displacement(i));
  return sum;
}

double water_energy(const Model& model) {
  const Particles& p = model.particles;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double before = model.water.pore_pressure(p.start[i].x(), p.start[i].y());
    sum += p.volume(i) * (p.pore_pressure[i] - before);
  }
  return -sum;
}

double unbalanced_force_ratio(const Model& model, std::span<const Vec2> accelerations) {
  double force = 0, weight = 0;
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    const double m2 = model.particles.mass[i] * model.particles.mass[i];
    force += m2 * accelerations[i].squaredNorm();
    weight += m2 * model.gravity.squaredNorm();
  }
  return weight > 0 ? std::sqrt(force / weight) : std::numeric_limits<double>::infinity();
}

}  // namespace porosph
