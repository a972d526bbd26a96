#include "solver/case/demand.hpp"

#include <algorithm>
#include <cmath>

#include "solver/case/shapes.hpp"
#include "solver/constitutive/linear_elastic.hpp"

namespace porosph {
namespace {

constexpr double bytes_per_particle = 1200;  // state, about 20 neighbours, their gradients

/// Of the fastest compression wave, in the lightest state of each soil [m/s].
double wave_speed(const Case& scene) {
  double fastest = 0;
  for (const SoilCase& soil : scene.soils) {
    const double modulus =
        LinearElastic::from_young(soil.youngs_modulus, soil.poissons_ratio).constrained_modulus();
    const double density =
        std::min(soil.unit_weight_saturated, soil.unit_weight_unsaturated) / scene.loading.gravity;
    if (density > 0) fastest = std::max(fastest, std::sqrt(modulus / density));
  }
  return fastest;
}

}  // namespace

Demand demand_of(const Case& scene) {
  double whole = 0;
  for (const SoilCase& soil : scene.soils) whole += area(soil);
  Demand demand;
  demand.particles = whole / (scene.particles.spacing * scene.particles.spacing);
  demand.bytes = demand.particles * bytes_per_particle + 1e7;
  const double time_step_bound = scene.time.courant * scene.smoothing_length();
  demand.steps = scene.time.step > 0 ? scene.time.end / scene.time.step
                                     : scene.time.end * wave_speed(scene) / time_step_bound;
  return demand;
}

}  // namespace porosph
