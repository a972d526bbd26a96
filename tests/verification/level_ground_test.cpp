// Level ground between rollers, where every answer is known by hand: lattices that do not fit the box, and
// water that ends at its base.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/monitor/zigzag.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double weight = 20e3;  // N/m3

Case ground(double width, double depth, double spacing, Arrangement arrangement) {
  Case scene = box_of_soil(1, 1, spacing);
  SoilCase& soil = scene.soils[0];
  soil.polygon = box_outline(0, 0, width, depth);
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = weight;
  scene.particles.arrangement = arrangement;
  scene.formulation = default_formulation(Motion::consistent);
  hold_as_column(scene);
  scene.loading.adaptive_damping = true;
  scene.time.courant = 0.7, scene.time.end = 20;
  scene.stop.unbalanced_force_ratio = 1e-6;
  return scene;
}

Simulation at_rest(const Case& scene) {
  Simulation simulation(scene);
  run_to_end(simulation);
  return simulation;
}

/// Largest difference from the weight above and what it presses sideways, over the weight of all [-].
double largest_error(const Simulation& simulation, double depth) {
  const double nu = simulation.scene().soils[0].poissons_ratio;
  const Particles& p = simulation.model().particles;
  double worst = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double yy = -weight * (depth - p.start[i].y());
    worst = std::max({worst, std::abs(p.stress[i].yy - yy), std::abs(p.stress[i].xx - nu / (1 - nu) * yy)});
  }
  return worst / (weight * depth);
}

}  // namespace

TEST_CASE("a lattice that does not fit the box still carries its weight", "[ground]") {
  const auto [width, depth, spacing] = GENERATE(std::tuple(6.0, 4.0, 0.27), std::tuple(5.3, 4.1, 0.25));
  const Arrangement arrangement = GENERATE(Arrangement::fitted, Arrangement::lattice);
  const double ratio = GENERATE(1.0, 1.2);
  CAPTURE(width, spacing, static_cast<int>(arrangement), ratio);
  Case scene = ground(width, depth, spacing, arrangement);
  scene.particles.smoothing_ratio = ratio;
  const Simulation simulation = at_rest(scene);
  CHECK(largest_error(simulation, depth) < (arrangement == Arrangement::fitted ? 0.02 : 0.12));
  CHECK(measure_zigzag(simulation.model()).rms < 0.02);
}

TEST_CASE("water that ends at the base of dry ground presses nowhere", "[ground]") {
  const Arrangement arrangement = GENERATE(Arrangement::surface, Arrangement::lattice);
  const double spacing = GENERATE(0.25, 0.5);
  CAPTURE(static_cast<int>(arrangement), spacing);
  Case scene = ground(4, 4, spacing, arrangement);
  scene.particles.smoothing_ratio = 1;
  const Simulation dry = at_rest(scene);
  add_water(scene, 0);
  const Simulation wet_below = at_rest(scene);
  const Particles &a = dry.model().particles, &b = wet_below.model().particles;
  double off = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    off = std::max(off, std::abs(a.stress[i].yy - b.stress[i].yy) / (weight * 4));
  CHECK(off < 1e-9);
}
