// Where the energy goes that gravity releases: all of it is found.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/energy_budget.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;

namespace {

Summary::EnergyBudget budget_after(const Case& scene) {
  Simulation simulation(scene);
  const double at_start = simulation.energy().total();
  while (simulation.step() < simulation.last_step() && !simulation.instability()) simulation.advance();
  REQUIRE_FALSE(simulation.instability());
  const auto budget = energy_budget(simulation, at_start);
  REQUIRE(budget);
  return *budget;
}

/// A block of 0.2 m x 0.1 m between a roller at its left and a base.
Case block(BoundaryKind base, double spacing) {
  Case scene = box_of_soil(static_cast<int>(std::lround(0.2 / spacing)),
                           static_cast<int>(std::lround(0.1 / spacing)), spacing);
  SoilCase& soil = scene.soils[0];
  soil.youngs_modulus = 0.84e6, soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20.4e3;
  add_wall(scene, base, {0, 0}, {1, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 0.12});
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_control = 0.1;
  scene.stop.on_separation = false;
  scene.time.courant = 0.8, scene.time.end = 0.6;
  return scene;
}

}  // namespace

TEST_CASE("the work of friction on a wall is found", "[energy]") {
  Case scene = block(BoundaryKind::friction, 0.005);
  scene.soils[0].law = LawKind::drucker_prager;
  scene.soils[0].strength.friction_angle = 30;
  scene.boundaries[0].coefficient = 0.2;
  const Summary::EnergyBudget e = budget_after(scene);
  CAPTURE(e.released, e.plastic, e.friction, e.control, e.contact, e.unaccounted);
  CHECK(e.friction > 0.1 * e.released);
  CHECK(e.plastic > 0.1 * e.released);
  CHECK(std::abs(e.unaccounted) < 0.01 * e.released);
}

TEST_CASE("the energy of a collapse on a fixed base is found", "[energy]") {
  Case scene = block(BoundaryKind::fixed, 0.005);
  scene.soils[0].law = LawKind::drucker_prager;
  scene.soils[0].strength.friction_angle = 19.8;
  const Summary::EnergyBudget e = budget_after(scene);
  CAPTURE(e.released, e.plastic, e.friction, e.control, e.contact, e.unaccounted);
  CHECK(e.friction == 0);
  CHECK(std::abs(e.unaccounted) < 0.01 * e.released);
}

TEST_CASE("the energy of Cam-clay that fails is found, its elastic part along the swelling line",
          "[energy]") {
  Case scene = block(BoundaryKind::fixed, 0.005);
  SoilCase& soil = scene.soils[0];
  soil.law = LawKind::cam_clay;
  soil.youngs_modulus = 3e6;
  soil.cam_clay = {
      .ratio = 1, .lambda = 0.1, .kappa = 0.02, .void_ratio = 1, .preconsolidation = 1e3, .attraction = 200};
  scene.time.courant = 0.5;
  const Summary::EnergyBudget e = budget_after(scene);
  CAPTURE(e.released, e.kinetic, e.elastic, e.plastic, e.control, e.contact, e.unaccounted);
  CHECK(e.released > 0);
  CHECK(e.elastic > 0);
  CHECK(e.plastic > 0.3 * e.released);
  CHECK(std::abs(e.unaccounted) < 0.01 * e.released);
}

TEST_CASE("the elastic energy of Cam-clay is the work along its swelling line", "[energy]") {
  CamClay clay;
  clay.swelling = 0.01, clay.shear_ratio = 0.6, clay.attraction = 4e3, clay.bulk_modulus = 1e9;
  const auto at = [](double p) { return Stress{-p, -p, -p, 0}; };
  double work = 0;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const double p = 100e3 * (k + 0.5) / steps, modulus = (p + clay.attraction) / clay.swelling;
    work += p * 100e3 / steps / modulus;
  }
  CHECK(clay.swelling_energy(at(0)) == Approx(0).margin(1e-9));
  CHECK(clay.swelling_energy(at(100e3)) == Approx(work).epsilon(1e-6));
}
