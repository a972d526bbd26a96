// Each limit of the warnings: nothing is said at it, and something just beyond it.
#include "solver/case/known_limits.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

Case scene_of(Motion motion) {
  Case scene = box_of_soil(4, 8);
  scene.formulation = default_formulation(motion);
  return scene;
}

void check_limit(const Case& at, const Case& beyond, const std::string& key) {
  CHECK(known_failures(at).empty());
  const auto warnings = known_failures(beyond);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains(key));
}

}  // namespace

TEST_CASE("the largest Courant number, of the consistent form and of the paper's", "[limits]") {
  for (const auto& [motion, largest] : {std::pair{Motion::consistent, 1.0}, {Motion::proposed, 1.1}}) {
    Case at = scene_of(motion);
    at.formulation.zero_energy_control = 0;
    Case beyond = at;
    at.time.courant = largest, beyond.time.courant = largest + 0.01;
    check_limit(at, beyond, "time.courant");
  }
}

TEST_CASE("the largest zero-energy control at a Courant number", "[limits]") {
  for (const auto& [control, courant] : {std::pair{0.4, 0.9}, {0.36, 1.0}, {0.9, 0.4}}) {
    Case at = scene_of(Motion::consistent);
    at.formulation.zero_energy_control = control, at.time.courant = courant;
    Case beyond = at;
    beyond.formulation.zero_energy_control = control + 0.01;
    check_limit(at, beyond, "zero_energy_control");
  }
}

TEST_CASE("water above the ground with the conventional form", "[limits]") {
  Case at = scene_of(Motion::conventional);
  Case beyond = at;
  add_water(at, 4), add_water(beyond, 4.01);
  check_limit(at, beyond, "suction");
}

TEST_CASE("the least density ratio of eq. (25)", "[limits]") {
  Case at = scene_of(Motion::rho_squared);
  at.soils[0].unit_weight_unsaturated = 0.6 * at.soils[0].unit_weight_saturated;
  Case beyond = at;
  beyond.soils[0].unit_weight_unsaturated *= 0.99;
  check_limit(at, beyond, "rho_squared");
}

TEST_CASE("the least viscosity of a long run without damping", "[limits]") {
  Case scene = scene_of(Motion::proposed);
  const double nu = 0.33, height = 4, modulus = 15e6 * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const double period = 4 * height / std::sqrt(modulus * 9.81 / 20e3);
  SECTION("viscosity") {
    scene.time.end = 100 * period;
    Case beyond = scene;
    scene.formulation.artificial_viscosity_alpha = 0.1, beyond.formulation.artificial_viscosity_alpha = 0.099;
    check_limit(scene, beyond, "artificial_viscosity_alpha");
  }
  SECTION("time, without damping and after it has ended") {
    scene.formulation.artificial_viscosity_alpha = 0;
    scene.loading.damping = GENERATE(0.0, 0.01);
    const double damped = scene.loading.damping > 0 ? 3 : 0;
    if (damped > 0) scene.loading.damping_until = damped;
    Case beyond = scene;
    scene.time.end = damped + 24.9 * period, beyond.time.end = damped + 25.1 * period;
    check_limit(scene, beyond, "without damping");
  }
}

TEST_CASE("the largest disorder where gradients are not closed", "[limits]") {
  const bool paper = GENERATE(true, false);
  Case at = scene_of(paper ? Motion::proposed : Motion::consistent);
  at.formulation.closed_gradients = false;
  at.particles.arrangement = Arrangement::disordered;
  at.particles.disorder = 0.01;
  Case beyond = at;
  beyond.particles.disorder = 0.0101;
  check_limit(at, beyond, "particles.disorder");
  beyond.particles.disorder = 0.4, beyond.formulation = default_formulation(Motion::consistent);
  CHECK(known_failures(beyond).empty());
}

TEST_CASE("soil that flows undamped and dilates to several times its volume is warned of", "[limits]") {
  Case at = scene_of(Motion::consistent);
  SoilCase& soil = at.soils[0];
  soil.law = LawKind::drucker_prager;
  soil.strength.friction_angle = 30, soil.strength.dilation_angle = 5;
  soil.strength.dilation_limit = 0.5;
  Case beyond = at;
  beyond.soils[0].strength.dilation_limit = 0.51;
  check_limit(at, beyond, "dilation_limit = 0.51");
  beyond.loading.adaptive_damping = true;
  CHECK(known_failures(beyond).empty());
}
