#include "solver/case/demand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/case/inertia.hpp"
#include "solver/case/shapes.hpp"

namespace porosph {
namespace {

/// Measured peaks: state, images, remembered states, frames; neighbours, and their gradients where particles
/// do not share them.
double bytes_per_particle(const Case& scene) {
  const double support = 2 * scene.particles.smoothing_ratio,
               neighbours = std::numbers::pi * support * support;
  const bool shared = scene.particles.arrangement != Arrangement::disordered;
  const bool consistent = scene.formulation.motion == Motion::consistent;
  const double of_pair = scene.formulation.single_precision ? 23 : 35;
  if (!consistent) return 850 + neighbours * (shared ? 12 : 24);
  return 670 + neighbours * (shared ? 4 : of_pair);
}

/// Of the fastest compression wave, in the lightest state of each soil [m/s].
double wave_speed(const Case& scene) {
  const std::vector<double> inertia = inertia_over_mass(scene);
  double fastest = 0;
  for (std::size_t i = 0; i < scene.soils.size(); ++i)
    fastest = std::max(fastest, modulus_over_density(scene.soils[i], scene.loading.gravity) / inertia[i]);
  return std::sqrt(fastest);
}

}  // namespace

Demand demand_of(const Case& scene) {
  double whole = 0;
  for (const SoilCase& soil : scene.soils) whole += area(soil);
  Demand demand;
  demand.particles = whole / (scene.particles.spacing * scene.particles.spacing);
  demand.bytes = demand.particles * bytes_per_particle(scene);
  const double time_step_bound = scene.time.courant * scene.smoothing_length();
  if (scene.water.steps_by_flow()) return demand;  // flow steps are as long as their error allows
  demand.steps = scene.time.step > 0 ? scene.time.end / scene.time.step
                                     : scene.time.end * wave_speed(scene) / time_step_bound;
  return demand;
}

}  // namespace porosph
