// A layer on a base that shakes, against the sum of its modes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/run/base_motion.hpp"
#include "solver/run/run.hpp"
#include "tests/strip.hpp"

using namespace porosph;

namespace {

constexpr double pi = std::numbers::pi, height = 10;

/// Elastic, without weight, whose shear waves need `period` / 4 from base to surface [s].
struct Layer {
  Layer() : scene(periodic_strip(4, 20)) {
    scene.particles.arrangement = Arrangement::surface;
    scene.particles.smoothing_ratio = 1;
    scene.loading.gravity_applied = false;
    scene.formulation.zero_energy_control = 0;
    scene.formulation.bulk_viscosity = 0;
    scene.time.courant = 0.5;
    const SoilCase& soil = scene.soils[0];
    const double modulus = soil.youngs_modulus / (2 * (1 + soil.poissons_ratio));
    period = 4 * height / std::sqrt(modulus * scene.loading.gravity / soil.unit_weight_saturated);
  }
  Case scene;
  double period;
};

double surface_displacement(const Simulation& s) {
  const Particles& p = s.model().particles;
  double highest = -1, sum = 0;
  int count = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    if (p.start[a].y() > highest + 1e-9) highest = p.start[a].y(), sum = 0, count = 0;
    if (p.start[a].y() > highest - 1e-9) sum += p.displacement(a).x(), ++count;
  }
  return sum / count;
}

/// Displacement of the surface relative to the base, which has moved with a sin(w t) from t = 0 on:
/// sum over modes of shape sin(m y / H), m = (2 n - 1) pi / 2, participation 2 / m and frequency m V_s / H.
double of_modes(double a, double w, double period, double time) {
  double sum = 0;
  for (int n = 1; n <= 200; ++n) {
    const double m = (2 * n - 1) * pi / 2, wn = (2 * n - 1) * 2 * pi / period;
    sum -= std::sin(m) * 2 / m * a / (wn * wn - w * w) * (std::sin(w * time) - w / wn * std::sin(wn * time));
  }
  return sum;
}

}  // namespace

TEST_CASE("the base shakes as the case says", "[shaking]") {
  ShakingCase s;
  CHECK_FALSE(s.acts());
  CHECK(base_acceleration(s, 1) == 0);
  s.amplitude = 2, s.frequency = 0.5, s.cycles = 4, s.ramp = 2, s.start = 1;
  CHECK(base_acceleration(s, 0.9) == 0);
  CHECK(base_acceleration(s, 1.5) == Approx(2 * 0.125));
  CHECK(base_acceleration(s, 5.5) == Approx(2 * (4 - 2.25) / 2));
  CHECK(base_acceleration(s, 9.01) == 0);
  CHECK(end_of_shaking(s) == Approx(9));
  s.acceleration_over_time = {{1, 2}, {3, -2}};
  CHECK(base_acceleration(s, 0) == 2);
  CHECK(base_acceleration(s, 2.5) == Approx(-1));
}

TEST_CASE("a layer on a base that begins to move vibrates with a period of 4 H / V_s", "[shaking]") {
  Layer layer;
  layer.scene.shaking.acceleration_over_time = {{0, -1}};
  layer.scene.time.end = 4.2 * layer.period;
  Simulation s(layer.scene);
  // It swings from 0 to twice the rest under that acceleration, rho a H^2 / 2 G at the surface.
  std::vector<double> at_middle;
  const double rest = layer.period * layer.period / 32;
  double before = 0, largest = 0;
  while (s.step() < s.last_step()) {
    s.advance();
    const double now = surface_displacement(s);
    if (before < rest && now >= rest)
      at_middle.push_back(s.time() - s.time_step() * (now - rest) / (now - before));
    before = now, largest = std::max(largest, now);
  }
  REQUIRE(at_middle.size() >= 4);
  const double period = (at_middle[3] - at_middle[0]) / 3;
  INFO("period over 4 H / V_s: " << period / layer.period);
  CHECK(period == Approx(layer.period).epsilon(0.002));
  CHECK(largest == Approx(2 * rest).epsilon(0.01));
}

TEST_CASE("a layer follows a sine of its base as the sum of its modes does", "[shaking]") {
  Layer layer;
  const double w = GENERATE(0.6, 1.5) * 2 * pi / layer.period, a = 1;
  layer.scene.shaking.amplitude = a;
  layer.scene.shaking.frequency = w / (2 * pi);
  layer.scene.time.end = 4 * layer.period;
  Simulation s(layer.scene);
  double off = 0, size = 0;
  while (s.step() < s.last_step()) {
    s.advance();
    const double exact = of_modes(a, w, layer.period, s.time());
    off = std::max(off, std::abs(surface_displacement(s) - exact)), size = std::max(size, std::abs(exact));
  }
  INFO("largest error over largest displacement: " << off / size);
  CHECK(off < 0.03 * size);
}

TEST_CASE("the work of a base that shakes is the energy of elastic soil", "[shaking]") {
  Layer layer;
  layer.scene.shaking.amplitude = 1;
  layer.scene.shaking.frequency = 0.9 / layer.period;
  layer.scene.time.end = 3 * layer.period;
  layer.scene.time.courant = 0.2;
  Simulation s(layer.scene);
  while (s.step() < s.last_step()) s.advance();
  const Simulation::Energy energy = s.energy();
  CHECK(s.base().work() > 0);
  CHECK(energy.kinetic + energy.elastic == Approx(s.base().work()).epsilon(1e-3));
}

TEST_CASE("the history of a run tells the acceleration of its base", "[shaking]") {
  Layer layer;
  layer.scene.shaking.amplitude = 2, layer.scene.shaking.frequency = 3;
  layer.scene.time.end = 0.1;
  Simulation s(layer.scene);
  CHECK(history_columns(s) == std::vector<std::string>{"time", "base.acceleration"});
  std::vector<double> last;
  RunWatch watch;
  watch.history = [&](const std::vector<double>& row) { last = row; };
  run(s, watch);
  CHECK(last[1] == Approx(2 * std::sin(2 * pi * 3 * last[0])));
}
