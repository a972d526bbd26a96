// The force of an excess pore pressure is the adjoint of the rate at which soil changes its volume.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/sph/consistent/flowing_soil.hpp"
#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/step_by_hand.hpp"

using namespace porosph;

namespace {

/// A block of clay on a base, against a roller, free on its right; it spreads under its weight.
Case spreading_block(double strength, BoundaryKind base) {
  Case scene = box_of_soil(16, 16, 0.25);
  SoilCase& soil = scene.soils[0];
  soil.law = LawKind::tresca;
  soil.youngs_modulus = 3e6;
  soil.strength.cohesion = strength;
  add_wall(scene, base, {0, 0}, {60, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 8});
  scene.particles.arrangement = Arrangement::lattice;
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

struct Works {
  double of_force = 0, of_volume = 0, size = 0;
};

/// Of a pressure that loose particles do not bear, in a motion, both of which are noise.
Works works(Dynamics& dynamics, const Model& model) {
  const Particles& p = model.particles;
  const FlowingSoil* flow = dynamics.flow();
  Noise noise(7);
  std::vector<double> pressure, rate(p.size());
  std::vector<Vec2> velocity, push(p.size());
  std::vector<Mat2> rates(p.size());
  for (std::size_t a = 0; a < p.size(); ++a) {
    const bool bears = flow == nullptr || !flow->loose().soil_has_flowed() || !flow->loose().is(a);
    pressure.push_back(bears ? 1e4 * noise() : 0);
    velocity.push_back(noise.vector());
  }
  dynamics.excess_accelerations(pressure, push);
  dynamics.sliding_rates(velocity, rates);
  dynamics.volume_rates(rates, rate);
  Works w;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double force = p.mass[a] * push[a].dot(velocity[a]);
    w.of_force += force, w.size += std::abs(force);
    w.of_volume += p.volume(a) * pressure[a] * rate[a];
  }
  return w;
}

}  // namespace

TEST_CASE("pressure gives soil that flows the energy that its change of volume takes", "[water][dynamic]") {
  const BoundaryKind base = GENERATE(BoundaryKind::fixed, BoundaryKind::roller);
  const Case scene = spreading_block(8e3, base);
  Model model = build_model(scene);
  const auto dynamics = make_dynamics(scene.formulation, model);
  const double dt = 0.6 * model.smoothing_length / model.wave_speed;
  double largest = 0;
  for (int k = 0; k < 40; ++k) {
    step_by_hand(*dynamics, model, dt, 20);
    dynamics->prepare();
    const Works w = works(*dynamics, model);
    largest = std::max(largest, std::abs(w.of_force + w.of_volume) / w.size);
  }
  REQUIRE(dynamics->flow()->has_flowed());
  CHECK(dynamics->counts.refreshes > 20);
  CHECK(largest < 1e-12);
}
