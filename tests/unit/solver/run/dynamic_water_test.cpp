#include "solver/run/dynamic_water.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/case/case_file.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/run/kept_state.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// A column between rollers, at rest under its weight and water.
Case column(double height, int rows, WaterMode mode) {
  Case scene = box_of_soil(4, rows, height / rows);
  hold_as_column(scene);
  SoilCase& soil = scene.soils[0];
  soil.porosity = 0.4;
  soil.unit_weight_unsaturated = soil.unit_weight_saturated;
  if (mode == WaterMode::coupled) soil.permeability = {1e-3, 1e-3};
  add_water(scene, height + 0.5);
  scene.water.mode = mode;
  scene.water.coupling.motion = WaterMotion::dynamic;
  scene.particles.arrangement = Arrangement::lattice;
  scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.k0_stress = true;
  scene.time.courant = 0.9;
  return scene;
}

void load_top(Case& scene, double pressure) {
  const Polygon& outline = scene.soils[0].polygon;
  LoadCase q;
  q.name = "q", q.from = outline[3], q.to = outline[2];
  q.pressure = q.pressure_to = pressure;
  scene.loads = {q};
}

void run_to_end(Simulation& s) {
  while (s.step() < s.last_step() && !s.instability()) s.advance();
  if (s.instability()) FAIL(s.instability()->message);
}

double modulus_of(const Case& scene) {
  const double e = scene.soils[0].youngs_modulus, nu = scene.soils[0].poissons_ratio;
  return e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
}

constexpr double load = 10e3;

}  // namespace

TEST_CASE("neither permeability nor stiffness of the water changes the steps of soil in motion",
          "[water][dynamic]") {
  std::int64_t steps = 0;
  for (const double k : {1e-12, 1e-6, 1e-2})
    for (const double bulk_modulus : {1e6, 2.2e9, CouplingCase::incompressible}) {
      Case scene = column(4, 20, WaterMode::coupled);
      load_top(scene, load);
      scene.soils[0].permeability = {k, k};
      scene.water.coupling.bulk_modulus = bulk_modulus;
      scene.time.end = 0.5;
      Simulation s(scene);
      run_to_end(s);
      CAPTURE(k, bulk_modulus);
      CHECK((steps == 0 || s.step() == steps));
      steps = s.step();
      CHECK(s.water_in_motion()->misfit() < 1e-6);
      CHECK(std::abs(s.water_in_motion()->imbalance()) < 1e-12);
      CHECK(s.largest_displacement() < 0.01);
    }
}

TEST_CASE("soil in motion consolidates as in Terzaghi's solution where inertia is small",
          "[water][dynamic]") {
  constexpr double height = 4, factor = 0.2;
  Case scene = column(height, 20, WaterMode::coupled);
  load_top(scene, load);
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.time.end = factor * height * height * scene.water.unit_weight / (1e-3 * modulus_of(scene));
  Simulation s(scene);
  run_to_end(s);
  double error = 0, size = 0;
  for (std::size_t a = 0; a < s.model().particles.size(); ++a) {
    const double depth = 1 - s.model().particles.start[a].y() / height;
    double exact = 0;
    for (int m = 0; m < 100; ++m) {
      const double root = (2 * m + 1) * std::numbers::pi / 2;
      exact += 2 / root * std::sin(root * depth) * std::exp(-root * root * factor);
    }
    error += std::pow(-s.water_in_motion()->excess()[a] / load - exact, 2), size += exact * exact;
  }
  CHECK(std::sqrt(error / size) < 0.003);
}

TEST_CASE("a closed block of soil and water makes no energy", "[water][dynamic]") {
  Case scene = column(4, 20, WaterMode::undrained);
  scene.soils[0].polygon = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 4}}, {BoundaryKind::roller, {0, 0}, {4, 0}}};
  scene.loading.k0_stress = false;  // falls into its weight at once, and swings
  scene.formulation.zero_energy_control = scene.formulation.bulk_viscosity = 0;
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.time.courant = 0.5, scene.time.end = 0.6;
  Simulation s(scene);
  const double start = s.energy().total();
  double most = 0, early = 0;
  while (s.step() < s.last_step()) {
    s.advance();
    REQUIRE(!s.instability());
    const Simulation::Energy now = s.energy();
    most = std::max(most, now.kinetic + now.elastic);
    if (s.step() == s.last_step() / 3) early = (now.total() - start) / most;
  }
  const double late = (s.energy().total() - start) / most;
  CAPTURE(early, late);
  CHECK(std::abs(early) < 0.0015);  // what the sudden start leaves
  CHECK(late <= early);             // and no gain after it,
  CHECK(late - early > -0.0006);    // but what the implicit pressure damps in 400 steps
}

TEST_CASE("soil in motion continues from a kept state to the same bits", "[water][dynamic]") {
  Case scene = column(4, 10, WaterMode::coupled);
  load_top(scene, load);
  scene.formulation.refresh_strain = 1e-5;  // so that its reference is renewed before and after
  scene.time.end = 0.5;
  Simulation first(scene);
  const int steps_before = GENERATE(1, 7, 60);
  for (int k = 0; k < steps_before; ++k) first.advance();
  if (GENERATE(false, true)) first.accelerations();  // as whoever writes a frame asks for
  const KeptState kept(first);
  run_to_end(first);
  REQUIRE(first.water_in_motion()->counts().renewals > 1);
  Simulation second(scene);
  kept.restore(second);
  run_to_end(second);
  CHECK(second.model().particles.position == first.model().particles.position);
  CHECK(second.model().particles.pore_pressure == first.model().particles.pore_pressure);
  CHECK(std::ranges::equal(second.water_in_motion()->head(), first.water_in_motion()->head()));
  CHECK(second.water_in_motion()->drained() == first.water_in_motion()->drained());
}

namespace {

/// A block between smooth platens that keeps its water, pressed on from above by a load that grows.
Case pressed_block(double of_strength, int rows = 10) {
  constexpr double side = 2, cohesion = 10e3;
  Case scene = column(side, rows, WaterMode::undrained);
  SoilCase& soil = scene.soils[0];
  soil.polygon = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  soil.law = LawKind::mohr_coulomb;
  soil.strength.cohesion = cohesion, soil.strength.friction_angle = 25;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated =
      scene.water.unit_weight;  // no weight of its own
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, side}}, {BoundaryKind::roller, {0, 0}, {side, 0}}};
  const double strength = 2 * cohesion * std::cos(25 * std::numbers::pi / 180);  // q = 2 s_u, p'_0 = 0
  load_top(scene, of_strength * strength);
  scene.loads[0].over_time = {{0, 0}, {1, 1}};
  scene.time.end = 1.5;
  return scene;
}

}  // namespace

TEST_CASE("a block that keeps its water fails in motion at its undrained strength", "[water][dynamic]") {
  Simulation below(pressed_block(0.93)), above(pressed_block(1.07));
  run_to_end(below);
  while (above.step() < above.last_step() && !above.instability()) above.advance();
  CHECK(below.largest_displacement() < 0.01);
  CHECK(above.largest_displacement() > 0.05);
}

namespace {

/// The same, pressed on over a day, at rest until it fails.
Case slowly_pressed_block(double motion_time, int rows) {
  constexpr double day = 86400;
  Case scene = pressed_block(1.25, rows);
  scene.water.coupling.motion = WaterMotion::automatic;
  scene.water.coupling.motion_time = motion_time, scene.water.coupling.motion_interval = 0.1;
  scene.loads[0].over_time = {{0, 0}, {day, 1}};
  scene.time.end = scene.output.interval = day;
  return scene;
}

}  // namespace

TEST_CASE("a block that keeps its water loses equilibrium at its undrained strength, and moves from there",
          "[water][dynamic][automatic]") {
  constexpr double motion_time = 1;
  Simulation s(slowly_pressed_block(motion_time, 10));
  double at_rest = 0;
  while (s.step() < s.last_step() && !s.instability()) {
    if (!s.in_motion()) at_rest = s.largest_displacement();
    s.advance();
  }
  REQUIRE(s.in_motion());
  if (s.instability()) FAIL(s.instability()->message);
  CHECK(1.25 * s.failed_at() / 86400 == Approx(1).margin(0.003));
  CHECK(s.time() == Approx(s.failed_at() + motion_time).margin(1e-3));
  CHECK(s.largest_displacement() > 2 * at_rest);
  const Summary::EnergyBudget energy = energy_budget(s, 0).value();
  CAPTURE(s.failed_at(), at_rest, s.largest_displacement(), energy.released, energy.kinetic, energy.elastic,
          energy.plastic, energy.control, energy.water, energy.walls, energy.unaccounted);
  CHECK(energy.released > 0);
  CHECK(std::abs(energy.unaccounted) < 0.01 * energy.released);
  CHECK(std::abs(s.water_in_motion()->imbalance()) < 1e-12);
  CHECK(s.water_in_motion()->misfit() < 1e-4);
}

TEST_CASE("soil that is loaded over decades moves in steps of its own once it fails",
          "[water][dynamic][automatic]") {
  const double years = 30 * 365.25 * 86400;
  Case scene = slowly_pressed_block(0.02, 5);
  scene.loads[0].over_time = {{0, 0}, {years, 1}};
  scene.time.end = scene.output.interval = years;
  scene.water.coupling.first_step = years / 10;
  scene.time.courant = 0.2;
  Simulation s(scene);
  while (!s.in_motion()) s.advance();
  const double failed_at = s.time();
  for (int k = 0; k < 10; ++k) s.advance();
  CHECK(s.moves() == 10);
  CHECK(s.time() > failed_at);
  CHECK(s.step_length() < 0.2 * s.model().smoothing_length / s.model().wave_speed);
  CHECK(s.step_length() > 0.15 * s.model().smoothing_length / s.model().wave_speed);
  scene.time.end = 1e15;
  CHECK_THROWS_WITH(Simulation(scene), Catch::Contains("is too long to count in steps of"));
}

TEST_CASE("soil that has lost its equilibrium continues from a kept state to the same bits",
          "[water][dynamic][automatic]") {
  Simulation whole(slowly_pressed_block(1, 5));
  std::vector<KeptState> kept;  // at rest, as equilibrium is lost, in motion
  while (whole.time() < 60000) whole.advance();
  kept.emplace_back(whole);
  while (!whole.in_motion()) whole.advance();
  kept.emplace_back(whole);
  for (int k = 0; k < 40; ++k) whole.advance();
  kept.emplace_back(whole);
  for (int k = 0; k < 40; ++k) whole.advance();
  REQUIRE_FALSE(whole.instability());
  for (const KeptState& state : kept) {
    Simulation resumed(slowly_pressed_block(1, 5));
    state.restore(resumed);
    while (resumed.moves() < whole.moves()) resumed.advance();
    CHECK(KeptState(whole) == KeptState(resumed));
  }
}
