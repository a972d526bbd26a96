// Strength reduction on small scenes; docs/safety.md has the accuracy on finer ones.
#include "solver/run/strength_reduction.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/case/case_file.hpp"
#include "solver/run/kept_state.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/staged.hpp"

using namespace porosph;

namespace {

double tangent(double degrees) { return std::tan(degrees * std::acos(-1) / 180); }

/// Griffiths and Lane (1999), example 1: factor of safety 1.4.
Case slope(double spacing) {
  Case scene = box_of_soil(2, 2, spacing);
  SoilCase& soil = scene.soils[0];
  soil.polygon = {{0, 0}, {32, 0}, {12, 10}, {0, 10}};
  soil.youngs_modulus = 1e8, soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20e3;
  soil.law = LawKind::drucker_prager;
  soil.strength.cohesion = 10e3, soil.strength.friction_angle = 20;
  scene.particles.arrangement = Arrangement::fitted;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {32, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 10});
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

/// The same slope, dug out of level ground.
Case dug_slope(double spacing) {
  Case scene = slope(spacing);
  scene.soils[0].polygon = {{0, 0}, {32, 0}, {32, 10}, {0, 10}};
  scene.boundaries[1].to.y() = 12;
  add_wall(scene, BoundaryKind::roller, {32, 0}, {32, 12});
  scene.loading.k0_stress = scene.loading.adaptive_damping = true;
  scene.time.courant = 0.6, scene.time.end = 5;
  scene.stop.unbalanced_force_ratio = 1e-4;
  StageCase dig;
  dig.name = "dig", dig.duration = 20, dig.safety = true;
  dig.excavate_within = {{{12, 10}, {32, 0}, {33, 0}, {33, 10}}};
  scene.stages.push_back(dig);
  return scene;
}

}  // namespace

TEST_CASE("a weakened case has its cohesion and tan(phi) divided", "[safety]") {
  Case scene = slope(1);
  scene.soils[0].strength.dilation_angle = 20;
  SoilCase clay = scene.soils[0], rock = scene.soils[0];
  clay.law = LawKind::tresca;
  clay.strength.undrained_strength = 40e3, clay.strength.growth = 2e3;
  rock.law = LawKind::elastic;
  scene.soils.push_back(clay), scene.soils.push_back(rock);
  const Case weak = weakened(scene, 1.6);
  const StrengthCase& s = weak.soils[0].strength;
  CHECK(s.cohesion == Approx(10e3 / 1.6));
  CHECK(tangent(s.friction_angle) == Approx(tangent(20) / 1.6));
  CHECK(s.dilation_angle <= s.friction_angle);
  CHECK(weak.soils[1].strength.undrained_strength == Approx(25e3));
  CHECK(weak.soils[1].strength.growth == Approx(1250));
  CHECK(weak.soils[2].law == LawKind::elastic);
}

TEST_CASE("strength reduction finds the slope's factor, whatever it begins with", "[safety]") {
  const double guess = GENERATE(0.7, 1.35, 2.5);
  const int jobs = guess == 1.35 ? 2 : 1;
  CAPTURE(guess, jobs);
  int finished = 0;
  const StrengthReduction found = reduce_strength(
      slope(1),
      {.bracket = 0.03, .first_guess = guess, .jobs = jobs, .finished = [&](const auto&) { ++finished; }});
  CHECK(found.fails_at - found.stable_at <= 0.03 * (1 + 1e-9));
  CHECK(found.stable_at > 1.33);  // coarse: a cell is a tenth of the height
  CHECK(found.fails_at < 1.47);
  REQUIRE(found.mechanism);
  CHECK(static_cast<std::size_t>(finished) == found.trials.size());
  CHECK(std::ranges::is_sorted(found.trials, {}, &StrengthTrial::factor));
  for (const StrengthTrial& t : found.trials) CHECK(t.stable() == (t.factor <= found.stable_at));
}

TEST_CASE("a factor below one is found, and none where the soil cannot fail", "[safety]") {
  Case weak = slope(1);
  weak.soils[0].strength.cohesion = 5e3, weak.soils[0].strength.friction_angle = 10;
  const StrengthReduction found = reduce_strength(weak, {.bracket = 0.05, .first_guess = 0.7, .jobs = 2});
  // c and tan(phi) of example 1 divided by 2 and 2.06
  CHECK(found.stable_at > 0.6);
  CHECK(found.fails_at < 0.75);
  Case strong = slope(1);
  strong.soils[0].strength.cohesion = 1e9;
  const StrengthReduction none = reduce_strength(strong, {.bracket = 0.1, .first_guess = 2, .most = 3});
  CHECK(none.fails_at == never);
  CHECK_FALSE(none.mechanism);
}

TEST_CASE("a slope that was dug has the factor of one that always was there", "[safety]") {
  const Case scene = dug_slope(1);
  const auto last = run_stages(scene);
  const HandedOver state = last->hand_over();
  const StrengthReduction at_once = reduce_strength(slope(1), {.bracket = 0.02, .jobs = 2});
  const StrengthReduction dug =
      reduce_strength(last_stage(scene), {.bracket = 0.02, .jobs = 2, .from = &state});
  CHECK(dug.stable_at == Approx(at_once.stable_at).margin(0.021));
  CHECK(dug.fails_at == Approx(at_once.fails_at).margin(0.021));
  REQUIRE(dug.mechanism);
  REQUIRE(dug.strain_before.size() == dug.mechanism->model().particles.size());
  double most_before = 0;
  for (const double strain : dug.strain_before) most_before = std::max(most_before, strain);
  CHECK(most_before > 0);  // the toe yields while it is dug
  // Displacements count from the state: far from failure the soil hardly moves on.
  const StrengthReduction same =
      reduce_strength(last_stage(scene), {.bracket = 1, .first_guess = 1, .from = &state});
  REQUIRE(same.trials.front().factor == Approx(0.97));
  CHECK(same.trials.front().displacement < 0.1 * same.at_rest);
}

TEST_CASE("a simulation continues from a kept state to the same bits", "[safety]") {
  Case scene = slope(1);
  scene.time.end = 1, scene.formulation.refresh_strain = never;
  Simulation first(scene);
  for (int k = 0; k < 60; ++k) first.advance();
  const KeptState kept(first);
  for (int k = 0; k < 40; ++k) first.advance();
  Simulation second(scene);
  kept.restore(second);
  CHECK(second.step() == 60);
  for (int k = 0; k < 40; ++k) second.advance();
  CHECK(second.model().particles.position == first.model().particles.position);
  CHECK(second.model().particles.velocity == first.model().particles.velocity);
  Simulation other(slope(2));
  CHECK_THROWS_AS(kept.restore(other), StateError);
}

TEST_CASE("strength reduction says what it cannot do", "[safety]") {
  Case elastic = slope(1);
  elastic.soils[0].law = LawKind::elastic;
  CHECK_THROWS_WITH(reduce_strength(elastic, {}), Catch::Contains("no soil of the case has a strength"));
  Case pushed = slope(1);
  pushed.footings.push_back(
      {.name = "plate", .from = {2, 10}, .to = {6, 10}, .settlement = 0.1, .over_time = {}});
  CHECK_THROWS_WITH(reduce_strength(pushed, {}), Catch::Contains("driven by its settlement"));
  Case weightless = slope(1);
  weightless.loading.gravity_applied = false;
  CHECK_THROWS_WITH(reduce_strength(weightless, {}), Catch::Contains("gravity_applied"));
}
