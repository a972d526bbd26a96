#include "solver/run/highest_frequency.hpp"

#include <cmath>
#include <random>

#include "solver/space/parallel.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {
namespace {

constexpr int iterations = 40;

double norm(const std::vector<Vec2>& v) {
  return std::sqrt(deterministic_sum(v.size(), [&](std::size_t i) { return v[i].squaredNorm(); }));
}

/// So that nothing but the stress under a strain tells in the accelerations.
FormulationCase without_viscosity(FormulationCase f) {
  f.artificial_viscosity_alpha = f.artificial_viscosity_beta = f.artificial_stress = 0;
  f.bulk_viscosity = f.zero_energy_control = 0;
  return f;
}

}  // namespace

double highest_frequency(const FormulationCase& formulation, Model model, const ScaledInertia& inertia) {
  for (Soil& soil : model.soils) soil = Soil(LinearElastic{soil.elastic()});
  const auto dynamics = make_dynamics(without_viscosity(formulation), model);
  std::vector<Vec2>& v = model.particles.velocity;
  std::mt19937_64 random(1);
  for (Vec2& x : v) x = Vec2(std::ldexp(random(), -63) - 1, std::ldexp(random(), -63) - 1);

  const double dt = 0.1 * model.smoothing_length / model.wave_speed;
  const double small = 1e-8 * model.wave_speed * std::sqrt(static_cast<double>(v.size()));
  std::vector<Vec2> before(v.size()), after(v.size());
  dynamics->prepare();
  dynamics->accelerations(before);
  double scale = small / norm(v), frequency_squared = 0;
  for (int k = 0; k < iterations; ++k) {
    for (Vec2& x : v) x *= scale;
    dynamics->strain(dt);
    dynamics->accelerations(after);
    for (std::size_t a = 0; a < v.size(); ++a) v[a] = (before[a] - after[a]) / dt;
    inertia.scale(v);
    frequency_squared = norm(v) / small;
    scale = small / norm(v);
    before.swap(after);
  }
  return std::sqrt(frequency_squared);
}

}  // namespace porosph
