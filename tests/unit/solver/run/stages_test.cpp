// Stages against what they must come to: exact columns, the same load at once, nothing where nothing changes.
#include "tests/box_of_soil.hpp"
#include "tests/staged.hpp"

using namespace porosph;

namespace {

/// A column that comes to rest, `rows` cells of 0.5 m high.
Case resting_column(int rows, double youngs_modulus) {
  Case scene = box_of_soil(6, rows);
  scene.soils[0].youngs_modulus = youngs_modulus;
  scene.soils[0].unit_weight_unsaturated = 18e3;
  hold_as_column(scene);
  scene.particles.smoothing_ratio = 1;
  scene.particles.arrangement = Arrangement::stretched;
  scene.loading.adaptive_damping = true;
  scene.formulation.zero_energy_control = 0.1;
  scene.formulation.refresh_strain = 0.02;
  scene.time = {.end = 20, .courant = 0.6};
  scene.stop.unbalanced_force_ratio = 1e-8;
  return scene;
}

StageCase stage(const std::string& name) {
  StageCase s;
  s.name = name, s.duration = 20;
  return s;
}

double constrained_modulus(const SoilCase& soil) {
  return Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio).constrained_modulus();
}

std::vector<Vec2> displacements(const Simulation& s) {
  std::vector<Vec2> all;
  for (std::size_t i = 0; i < s.model().particles.size(); ++i)
    all.push_back(s.model().particles.displacement(i));
  return all;
}

/// Largest difference over the largest of either.
double apart(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, a[i].norm()), difference = std::max(difference, (a[i] - b[i]).norm());
  return difference / largest;
}

}  // namespace

TEST_CASE("a case without stages is its own and only stage") {
  const Case scene = resting_column(8, 15e6);
  const StagePlan plan(scene);
  CHECK(plan.is_last());
  CHECK(plan.name() == "start");
  CHECK(plan.scene().plan == nullptr);
  CHECK(plan.scene().soils[0].id == -1);
}

TEST_CASE("a stage without gravity lets the soil rise to where it was drawn") {
  Case scene = resting_column(8, 1e9);
  scene.loading.k0_stress = GENERATE(false, true);
  StageCase off = stage("off");
  off.set = {"loading.gravity_applied = false"};
  scene.stages = {off};
  const auto last = run_stages(scene);
  const double settlement = 18e3 * 4 * 4 / 2 / constrained_modulus(scene.soils[0]);
  const Particles& p = last->model().particles;
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, std::abs(p.stress[i].yy));
  CHECK(most < 1e-3 * 18e3 * 4);
  const double risen = last->largest_displacement();
  if (scene.loading.k0_stress)
    CHECK(risen == Approx(settlement).epsilon(0.05));
  else
    CHECK(risen < 1e-3 * settlement);
}

TEST_CASE("a stage that changes nothing leaves the soil at rest") {
  const double E = GENERATE(1e9, 1e11);
  Case scene = resting_column(8, E);
  scene.stages = {stage("nothing"), stage("again-nothing")};
  std::vector<std::vector<Vec2>> at_ends;
  std::vector<double> times;
  run_stages(scene, [&](const EndedStage& ended, Simulation& s) {
    CHECK(ended.outcome.status == RunStatus::equilibrium);
    at_ends.push_back(displacements(s)), times.push_back(ended.time);
    CHECK(s.unbalanced_force_ratio() < 1e-8);
  });
  REQUIRE(at_ends.size() == 3);
  // What is left is the strain: sums go over the geometry at the stage's beginning.
  const double strain = 18e3 * 4 / constrained_modulus(scene.soils[0]);
  CHECK(apart(at_ends[0], at_ends[1]) < 2 * strain);
  CHECK(apart(at_ends[0], at_ends[2]) < 2 * strain);
  CHECK(times[0] < times[1]);
  CHECK(times[1] < times[2]);
}

TEST_CASE("fill in two layers: each settles by what is placed on it and under its own weight") {
  const double E = GENERATE(200e6, 2e9);
  Case scene = resting_column(10, E);
  for (int layer = 1; layer <= 2; ++layer) {
    SoilCase fill = scene.soils[0];
    fill.name = "fill" + std::to_string(layer);
    fill.polygon = box_outline(0, 5 + 3 * (layer - 1), 3, 5 + 3 * layer);
    fill.youngs_modulus = layer == 1 ? E : E / 2;
    scene.soils.push_back(fill);
    StageCase s = stage("lift-" + std::to_string(layer));
    s.fill = {fill.name};
    scene.stages.push_back(s);
  }
  for (BoundaryCase& b : scene.boundaries) b.to.y() = b.from.x() == b.to.x() ? 11 : b.to.y();
  scene.probes = {{.name = "ground", .position = {1.5, 5}},
                  {.name = "first", .position = {1.5, 8}},
                  {.name = "second", .position = {1.5, 11}}};
  std::vector<std::vector<double>> settlement;
  const auto end = run_stages(scene, [&](const EndedStage&, Simulation& s) {
    settlement.emplace_back();
    for (const Probe& probe : s.probes())
      settlement.back().push_back(-probe.read(s.model().particles).displacement.y());
  });
  const double gamma = scene.soils[0].unit_weight_unsaturated, M = constrained_modulus(scene.soils[0]),
               M2 = constrained_modulus(scene.soils[2]);
  const double own = gamma * 25 / 2 / M, under_lift = gamma * 3 * 5 / M;
  CHECK(settlement[0][0] == Approx(own).epsilon(0.01));
  CHECK(std::isnan(settlement[0][1]));
  CHECK(settlement[1][0] == Approx(own + under_lift).epsilon(0.01));
  CHECK(settlement[1][1] == Approx(under_lift + gamma * 9 / 2 / M).epsilon(0.01));
  CHECK(settlement[2][0] == Approx(own + 2 * under_lift).epsilon(0.01));
  CHECK(settlement[2][1] == Approx(2 * under_lift + gamma * 9 / 2 / M + gamma * 9 / M).epsilon(0.01));
  CHECK(settlement[2][2] == Approx(under_lift + gamma * 9 / M + gamma * 9 / 2 / M2).epsilon(0.01));
  scene.stages.clear();
  Simulation at_once(scene);
  run(at_once, {});
  const Particles &p = end->model().particles, &q = at_once.model().particles;
  REQUIRE(p.size() == q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    CHECK(p.start[i] == q.start[i]);
    // Strain of the lower layers was summed at faces that were free then: the error of those rows differs.
    CHECK(p.stress[i].yy == Approx(q.stress[i].yy).margin(0.001 * gamma * 11));
    if (p.start[i].y() < 8) CHECK(p.stress[i].yy == Approx(-gamma * (11 - p.start[i].y())).epsilon(0.01));
  }
  CHECK(p.id == q.id);
  std::vector<std::int32_t> ids;
  for (const Soil& soil : end->model().soils) ids.push_back(soil.id());
  CHECK(ids == std::vector<std::int32_t>{0, 1, 2});
}

TEST_CASE("what is excavated is gone, and the rest rises by what it carried") {
  Case scene = resting_column(16, 1e9);
  StageCase dig = stage("dig");
  dig.excavate_within = {box_outline(-1, 5, 4, 9)};
  dig.reset_displacements = GENERATE(false, true);
  scene.stages = {dig};
  const auto end = run_stages(scene);
  const double gamma = scene.soils[0].unit_weight_unsaturated, M = constrained_modulus(scene.soils[0]);
  const Particles& p = end->model().particles;
  CHECK(p.size() == 60);
  const double margin = 0.015 * gamma * 12.5 / M;  // of rows at the base, of the largest displacement
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double y = p.start[i].y();
    const double own = -gamma * (5 * y - y * y / 2) / M, carried = -gamma * 3 * y / M;
    CHECK(p.displacement(i).y() ==
          Approx(dig.reset_displacements ? -carried : own).epsilon(0.01).margin(margin));
    if (y < 4.4) CHECK(p.stress[i].yy == Approx(-gamma * (5 - y)).epsilon(0.01));
  }
}

TEST_CASE("a load that comes and goes leaves nothing") {
  Case scene = resting_column(8, 1e11);
  scene.boundaries[1].to.y() = scene.boundaries[2].to.y() = 6;
  LoadCase load;
  load.name = "strip", load.from = {0.5, 4}, load.to = {2, 4}, load.pressure = load.pressure_to = 50e3;
  scene.loads = {load};
  StageCase on = stage("on"), off = stage("off");
  on.load_on = {"strip"}, off.load_off = {"strip"};
  on.ramp = off.ramp = GENERATE(0.0, 0.3);
  scene.stages = {on, off};
  std::vector<std::vector<Vec2>> at_ends;
  run_stages(scene, [&](const EndedStage& ended, Simulation& s) {
    INFO(ended.name << " at " << ended.time << " s, forces " << s.unbalanced_force_ratio() << ", damping "
                    << s.damping());
    CHECK(ended.outcome.status == RunStatus::equilibrium);
    at_ends.push_back(displacements(s));
  });
  CHECK(apart(at_ends[0], at_ends[1]) > 0.1);
  CHECK(apart(at_ends[0], at_ends[2]) < 1e-5);  // a few strains are left, as the geometry is that of the soil
}

TEST_CASE("a level that drops changes weight and pore pressure") {
  Case scene = resting_column(20, 1e11);
  scene.water.stretches = {{.level = 15}};
  StageCase half = stage("half");
  half.set = {"water.level = 12"};
  StageCase low = stage("low");
  low.set = {"water.level = 4"};
  scene.stages = {half, low};
  std::vector<std::vector<Vec2>> at_ends;
  const auto end =
      run_stages(scene, [&](const EndedStage&, Simulation& s) { at_ends.push_back(displacements(s)); });
  CHECK(apart(at_ends[0], at_ends[1]) < 1e-5);  // still above the ground
  const Particles& p = end->model().particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double y = p.start[i].y(), wet = std::max(0.0, 4 - y);
    CHECK(p.pore_pressure[i] == Approx(-9810 * wet).margin(50));
    if (y < 9.4) CHECK(p.stress[i].yy == Approx(-(18e3 * (10 - y - wet) + (20e3 - 9810) * wet)).margin(800));
  }
}

TEST_CASE("soil parameters of a stage hold from there") {
  Case scene = resting_column(8, 1e9);
  StageCase soft = stage("soft"), shaken = stage("shaken");
  soft.set = {"soil.soil.youngs_modulus = 5e8"};
  shaken.set = {"loading.horizontal = 0.1"};
  scene.stages = {soft, shaken};
  std::vector<std::vector<Vec2>> at_ends;
  const auto end =
      run_stages(scene, [&](const EndedStage&, Simulation& s) { at_ends.push_back(displacements(s)); });
  // Stress that is there needs no new strain.
  CHECK(apart(at_ends[0], at_ends[1]) < 5 * 18e3 * 4 / constrained_modulus(scene.soils[0]));
  CHECK(end->model().soils[0].elastic().constrained_modulus() ==
        Approx(constrained_modulus(scene.soils[0]) / 2).epsilon(1e-12));
  double shear = 0, weight = 0;  // on the base
  const Particles& p = end->model().particles;
  for (std::size_t i = 0; i < p.size(); ++i) weight += p.mass[i] * 9.81;
  CHECK(end->model().gravity.x() == Approx(0.981));
  for (const Vec2& u : at_ends[2]) shear = std::max(shear, u.x());
  CHECK(shear > 0);
  CHECK(weight == Approx(3 * 4 * 18e3).epsilon(1e-6));
}

TEST_CASE("a state of another case is taken over where soils are the same") {
  Case before = resting_column(8, 1e9);
  Simulation first(before);
  run(first, {});
  const HandedOver state = first.hand_over();
  SECTION("nothing changes") {
    Simulation second(before, {.state = &state});
    CHECK(apart(displacements(first), displacements(second)) == 0);
    run(second, {});
    CHECK(apart(displacements(first), displacements(second)) <
          2 * 18e3 * 4 / constrained_modulus(before.soils[0]));
  }
  SECTION("the same name for other soil is an error") {
    Case after = before;
    after.soils[0].polygon = box_outline(0, 0, 3, 3);
    after.boundaries[1].to.y() = after.boundaries[2].to.y() = 3;
    CHECK_THROWS_WITH(Simulation(after, Beginning{.state = &state}),
                      Catch::Matchers::Contains("soil 'soil' does not fit the state to start from: of its 36 "
                                                "particles 36 are where the 48 of that state were drawn"));
    after.particles.spacing = 0.4;
    CHECK_THROWS(Simulation(after, Beginning{.state = &state}));
  }
}

TEST_CASE("stages are not run by what knows nothing of them") {
  Case scene = resting_column(8, 1e9);
  scene.stages = {stage("next")};
  CHECK_THROWS_WITH(Simulation(scene), Catch::Matchers::Contains("the case has stages"));
}

TEST_CASE("soil that moves further than allowed has failed") {
  Case scene = resting_column(8, 1e6);
  scene.stop.displacement = 0.01;
  Simulation s(scene);
  const RunOutcome outcome = run(s, {});
  CHECK(outcome.failed);
  CHECK(s.largest_displacement() > 0.01);
  CHECK(s.largest_displacement() < 0.1);
}
