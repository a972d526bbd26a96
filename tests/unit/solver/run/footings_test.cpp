// Rigid footings: exact under uniform compression, and against the bearing capacity of Prandtl.
#include "solver/run/footings.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/case/case_file.hpp"
#include "solver/case/check_case.hpp"
#include "solver/case/check_stages.hpp"
#include "solver/case/known_limits.hpp"
#include "solver/run/kept_state.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/staged.hpp"

using namespace porosph;

namespace {

/// A weightless column under a plate on all of its top.
Case column(Arrangement arrangement) {
  Case scene = box_of_soil(6, 10, 0.5);
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {3, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 8});
  add_wall(scene, BoundaryKind::roller, {3, 0}, {3, 8});
  scene.particles.arrangement = arrangement, scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.gravity_applied = false, scene.loading.adaptive_damping = true;
  scene.time.courant = 0.5, scene.time.end = 10;
  FootingCase plate;
  plate.name = "plate", plate.from = {0, 5}, plate.to = {3, 5};
  scene.footings.push_back(plate);
  return scene;
}

void settle(Simulation& s, double ratio) {
  while (s.step() < s.last_step() && (s.step() % 20 != 19 || s.unbalanced_force_ratio() > ratio)) s.advance();
  s.accelerations();
}

/// Of the right half of a rough footing of 2 m on weightless ground with c = 10 kPa, phi = 0.
Case prandtl(double spacing) {
  Case scene = box_of_soil(2, 2, spacing);
  SoilCase& soil = scene.soils[0];
  soil.polygon = {{0, -2}, {4, -2}, {4, 0}, {0, 0}};
  soil.youngs_modulus = 10e6, soil.poissons_ratio = 0.3;
  soil.law = LawKind::tresca, soil.strength.undrained_strength = 10e3;
  add_wall(scene, BoundaryKind::fixed, {0, -2}, {4, -2});
  add_wall(scene, BoundaryKind::roller, {0, -2}, {0, 1});
  add_wall(scene, BoundaryKind::roller, {4, -2}, {4, 1});
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.gravity_applied = false, scene.loading.adaptive_damping = true;
  scene.time.courant = 0.6, scene.time.end = 12;
  FootingCase strip;
  strip.name = "strip", strip.from = {0, 0}, strip.to = {1, 0};
  strip.settlement = 0.04, strip.over_time = {{0, 0}, {4, 1}};
  scene.footings.push_back(strip);
  return scene;
}

}  // namespace

TEST_CASE("a plate on a column presses it uniformly", "[footing]") {
  const auto arrangement = GENERATE(Arrangement::lattice, Arrangement::surface);
  const bool by_force = GENERATE(true, false);
  Case scene = column(arrangement);
  CAPTURE(static_cast<int>(arrangement), by_force);
  const SoilCase& soil = scene.soils[0];
  const Elasticity elastic = Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio);
  const double modulus = elastic.constrained_modulus();
  FootingCase& plate = scene.footings[0];
  plate.rough = false;
  if (by_force)
    plate.force = 3e3;
  else
    plate.settlement = 1e3 * 5 / modulus, plate.over_time = {{0, 0}, {0.5, 1}};
  Simulation s(scene);
  settle(s, 1e-7);
  CHECK(s.step() < s.last_step());
  const Particles& p = s.model().particles;
  REQUIRE(s.footings().size() == 1);
  CHECK(s.footings()[0].width() == Approx(3).epsilon(1e-9));
  CHECK(s.footings()[0].force() == Approx(3e3).epsilon(2e-3));
  CHECK(s.footings()[0].settlement(p) == Approx(1e3 * 5 / modulus).epsilon(2e-3));
  for (std::size_t i = 0; i < p.size(); ++i) CHECK(p.stress[i].yy == Approx(-1e3).epsilon(5e-3));
}

TEST_CASE("a rough plate holds the soil along it, a smooth one lets it slide", "[footing]") {
  Case scene = column(Arrangement::surface);
  scene.boundaries.resize(1);  // no walls at the sides
  FootingCase& plate = scene.footings[0];
  plate.force = 3e3, plate.rough = GENERATE(true, false);
  Simulation s(scene);
  settle(s, 1e-6);
  const Particles& p = s.model().particles;
  double most = 0;
  for (const std::int32_t a : s.footings()[0].particles())
    if (p.start[a].y() > 4.9) most = std::max(most, std::abs(p.displacement(a).x()));
  const double inside = s.footings()[0].settlement(p);
  CHECK(inside > 0);
  if (plate.rough)
    CHECK(most < 0.05 * inside);
  else
    CHECK(most > 0.05 * inside);
}

TEST_CASE("a rough footing on clay bears what Prandtl says", "[footing]") {
  Case scene = prandtl(0.1);
  scene.particles.arrangement = GENERATE(Arrangement::lattice, Arrangement::surface);
  scene.particles.smoothing_ratio = GENERATE(1.15, 1.2, 1.3);
  CAPTURE(static_cast<int>(scene.particles.arrangement), scene.particles.smoothing_ratio);
  Simulation s(scene);
  while (s.time() < 4) s.advance();
  settle(s, 1e-4);
  CHECK(s.step() < s.last_step());
  const double factor = s.footings()[0].force() / 10e3;  // of half the footing, 1 m wide
  CAPTURE(factor);
  CHECK(factor == Approx(2 + std::numbers::pi).epsilon(0.02));
}

TEST_CASE("a footing with too few or too many neighbours around its edge is warned of", "[footing]") {
  Case scene = prandtl(0.1);
  const auto warned = [&](double ratio) {
    scene.particles.smoothing_ratio = ratio;
    return !known_failures(scene).empty();
  };
  CHECK(warned(1));
  CHECK(warned(1.149));
  CHECK_FALSE(warned(1.15));
  CHECK_FALSE(warned(1.3));
  CHECK(warned(1.301));
  scene.soils[0].law = LawKind::elastic;
  CHECK_FALSE(warned(1));
}

TEST_CASE("a footing on soil that yields has neighbours enough around its edge by default", "[footing]") {
  const auto ratio = [](const std::string& particles, const std::string& law) {
    const std::string text = R"([particles]
spacing = 0.5
)" + particles + R"(
[[soil]]
name = "soil"
polygon = [[0, 0], [8, 0], [8, 2], [0, 2]]
youngs_modulus = 1e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
)" + law + R"(
[[footing]]
name = "plate"
from = [2, 2]
to = [4, 2]
force = 1e3
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [8, 0]
[time]
end = 1
)";
    return parse_case(text, "footing.toml").particles.smoothing_ratio;
  };
  const std::string clay = "law = 'tresca'\nundrained_strength = 1e4";
  const auto arrangement = GENERATE("", "arrangement = 'surface'", "arrangement = 'stretched'");
  CHECK(ratio(arrangement, clay) == 1.2);
  CHECK(ratio(arrangement, "") == 1);
  CHECK(ratio(arrangement + std::string("\nsmoothing_ratio = 1"), clay) == 1);
}

TEST_CASE("a footing is placed, loaded and lifted in stages", "[footing]") {
  const auto arrangement = GENERATE(Arrangement::lattice, Arrangement::surface);
  CAPTURE(static_cast<int>(arrangement));
  Case scene = column(arrangement);
  const SoilCase& soil = scene.soils[0];
  const double modulus =
      Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio).constrained_modulus();
  // Under its own weight first; the column is 5 m high, the plate on all of its top.
  scene.loading.gravity_applied = true;
  scene.stop.unbalanced_force_ratio = 1e-6;
  FootingCase& plate = scene.footings[0];
  plate.rough = false, plate.force = 3e3;
  StageCase place, wait, push, lift;
  place.name = "place", place.duration = 10, place.footing_on = {"plate"}, place.ramp = 0.2;
  wait.name = "wait", wait.duration = 10, wait.reset_displacements = true;
  push.name = "push", push.duration = 10, push.set = {"footing.plate.force = 6e3"};
  lift.name = "lift", lift.duration = 10, lift.footing_off = {"plate"};
  scene.stages = {place, wait, push, lift};
  REQUIRE(check_stages(scene).empty());
  const double settles = 1e3 * 5 / modulus;  // under 3 kN/m
  double height = 0;                         // of the highest particles
  std::vector<double> tops;
  run_stages(scene, [&](const EndedStage& ended, Simulation& s) {
    CAPTURE(ended.name);
    CHECK(ended.outcome.status == RunStatus::equilibrium);
    const Particles& p = s.model().particles;
    std::size_t top = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.start[i].y() > p.start[top].y()) top = i;
    tops.push_back(p.position[top].y() - p.start[top].y());
    height = p.start[top].y();
    if (ended.name == "start" || ended.name == "lift") {
      CHECK(s.footings().empty());
      return;
    }
    REQUIRE(s.footings().size() == 1);
    s.accelerations();
    const double times = ended.name == "push" ? 2 : 1;
    CHECK(s.footings()[0].force() == Approx(3e3 * times).epsilon(2e-3));
    // From when it was placed, on ground that had settled, through all stages.
    CHECK(s.footings()[0].settlement(p) == Approx(settles * times).epsilon(0.01));
  });
  REQUIRE(tops.size() == 5);
  CHECK(tops[1] - tops[0] == Approx(-settles * height / 5).epsilon(0.02));
  CHECK(tops[4] == Approx(tops[0]).epsilon(0.02));
}

TEST_CASE("a footing is driven by its settlement in a stage", "[footing]") {
  Case scene = column(Arrangement::surface);
  const Elasticity elastic =
      Elasticity::from_young(scene.soils[0].youngs_modulus, scene.soils[0].poissons_ratio);
  scene.loading.gravity_applied = true, scene.stop.unbalanced_force_ratio = 1e-6;
  FootingCase& plate = scene.footings[0];
  plate.rough = false, plate.settlement = 1e3 * 5 / elastic.constrained_modulus();
  plate.over_time = {{0, 0}, {0.5, 1}};
  StageCase press;
  press.name = "press", press.duration = 10, press.footing_on = {"plate"};
  scene.stages = {press};
  REQUIRE(check_stages(scene).empty());
  const auto pressed = run_stages(scene);
  CHECK(pressed->footings()[0].settlement(pressed->model().particles) == Approx(plate.settlement));
  CHECK(pressed->footings()[0].force() == Approx(3e3).epsilon(0.01));
}

TEST_CASE("a state with a footing is kept and continues to the same bits", "[footing]") {
  Case scene = column(Arrangement::surface);
  scene.loading.gravity_applied = true, scene.stop.unbalanced_force_ratio = 1e-4;
  scene.footings[0].force = 3e3;
  StageCase place;
  place.name = "place", place.duration = 10, place.footing_on = {"plate"};
  scene.stages = {place};
  StagePlan plan(scene);
  Simulation start(plan.scene());
  run(start, {});
  const HandedOver state = start.hand_over();
  REQUIRE(plan.go_on(start.time()).empty());
  const Beginning beginning{.time = start.time(), .state = &state};
  Simulation first(plan.scene(), beginning);
  for (int k = 0; k < 30; ++k) first.advance();
  const KeptState kept(first);
  for (int k = 0; k < 30; ++k) first.advance();
  Simulation second(plan.scene(), {.time = start.time()});
  kept.restore(second);
  for (int k = 0; k < 30; ++k) second.advance();
  CHECK(second.model().particles.position == first.model().particles.position);
  CHECK(second.footings()[0].settlement(second.model().particles) ==
        first.footings()[0].settlement(first.model().particles));
}

TEST_CASE("a footing that cannot be is refused", "[footing]") {
  const auto issues_of = [](auto&& change) {
    Case scene = column(Arrangement::surface);
    scene.footings[0].force = 1e3;
    change(scene, scene.footings[0]);
    std::string all;
    for (const CaseIssue& issue : check_geometry(scene)) all += issue.key + ": " + issue.message + "\n";
    return all;
  };
  using Catch::Contains;
  CHECK(issues_of([](Case&, FootingCase&) {}).empty());
  CHECK_THAT(issues_of([](Case&, FootingCase& f) { f.settlement = 0.1; }),
             Contains("footing[0]: footing 'plate' needs one of 'force' and 'settlement'"));
  CHECK_THAT(issues_of([](Case&, FootingCase& f) { f.force = never, f.settlement = 0.1; }),
             Contains("footing[0].over_time: must begin with [0, 0]"));
  CHECK_THAT(issues_of([](Case&, FootingCase& f) {
               f.from = f.to = {1, 2}, f.to.x() = 2;
             }),
             Contains("does not lie on the outline"));
  CHECK_THAT(issues_of([](Case& c, FootingCase&) { c.boundaries[1].to.y() = 5; }),
             Contains("a wall beside a footing must extend"));
  CHECK_THAT(issues_of([](Case& c, FootingCase&) { c.formulation.motion = Motion::proposed; }),
             Contains("needs formulation.motion"));
  for (const WaterMode mode : {WaterMode::coupled, WaterMode::undrained})
    CHECK_THAT(
        issues_of([&](Case& c, FootingCase& f) { c.water.mode = mode, f.force = never, f.settlement = 0.1; }),
        Contains("with water.mode = \"" + std::string(name(mode)) + "\" a footing needs 'force'"));
  CHECK_THAT(issues_of([](Case& c, FootingCase&) { c.probes.push_back({.name = "plate"}); }),
             Contains("footing[0].name: 'plate' is the name of a probe too"));
}
