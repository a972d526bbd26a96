#include "solver/run/run.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/reference_errors.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

Case column() {
  Case scene = box_of_soil(4, 6);
  hold_as_column(scene);
  add_water(scene, 4);
  scene.time.end = 0.1;
  scene.probes = {{"A", {1, 1}}, {"B", {1, 2}}};
  return scene;
}

}  // namespace

TEST_CASE("a run goes to its end time and tells its watch what is due", "[simulation]") {
  Case scene = column();
  scene.output.interval = 0.05;
  Simulation simulation(scene);
  std::vector<double> frame_times;
  std::vector<std::vector<double>> rows;
  std::int64_t progressed = 0;
  const RunOutcome outcome =
      run(simulation, {.frame = [&](Simulation& s) { frame_times.push_back(s.time()); },
                       .history = [&](const std::vector<double>& row) { rows.push_back(row); },
                       .progress = [&](const Simulation&) { ++progressed; },
                       .interrupted = {}});
  CHECK(outcome.status == RunStatus::completed);
  CHECK(outcome.message.empty());
  CHECK(simulation.time() == Approx(0.1));
  CHECK(progressed == simulation.last_step());
  REQUIRE(frame_times.size() == 3);
  CHECK(frame_times[1] == Approx(0.05).margin(0.6 * simulation.time_step()));
  CHECK(static_cast<std::int64_t>(rows.size()) == simulation.last_step() + 1);
  const auto columns = history_columns(simulation);
  REQUIRE(columns.size() == 15);
  CHECK(columns[0] == "time");
  CHECK(columns[2] == "A.EffectiveStress_YY");
  CHECK(columns[14] == "B.Displacement_Y");
  CHECK(rows.back().size() == 15);
  CHECK(rows.back()[0] == Approx(0.1));
  CHECK(rows.back()[2] < 0);
}

TEST_CASE("a damped run stops at equilibrium, at the right stress", "[simulation]") {
  Case scene = column();
  scene.time.end = 20;
  scene.loading.damping = 0.05;
  scene.stop.unbalanced_force_ratio = 1e-3;
  Simulation simulation(scene);
  const RunOutcome outcome = run(simulation, {});
  CHECK(outcome.status == RunStatus::equilibrium);
  CHECK_THAT(outcome.message, Catch::Contains("0.001"));
  CHECK(simulation.time() < 5);
  CHECK(outcome.energy_growth <
        -0.9);  // damping took the half of the work that is not stored, as much as is stored
  CHECK(simulation.unbalanced_force_ratio() < 1e-3);
  CHECK(simulation.probes()[0].read(simulation.model().particles).stress.yy ==
        Approx(-(20e3 - 9810) * 2).epsilon(0.03));
}

TEST_CASE("a time step that is too large ends the run with the particle's name", "[simulation]") {
  Case scene = column();
  scene.time.end = 10;
  scene.time.courant = 5;
  scene.formulation.motion = GENERATE(Motion::proposed, Motion::consistent);
  Simulation simulation(scene);
  int frames = 0;
  const RunOutcome outcome = run(simulation, {.frame =
                                                  [&](Simulation& s) {
                                                    ++frames;
                                                    for (const Vec2& x : s.model().particles.position)
                                                      CHECK(x.allFinite());
                                                  },
                                              .history = {},
                                              .progress = {},
                                              .interrupted = {}});
  CHECK(outcome.status == RunStatus::unstable);
  CHECK_THAT(outcome.message, Catch::Contains("particle") && Catch::Contains("time.courant"));
  CHECK(simulation.step() < simulation.last_step());
  CHECK(frames == 1);
  CHECK_FALSE(simulation.showable());
  const std::int64_t stopped = simulation.step();
  simulation.advance();
  CHECK(simulation.step() == stopped);
}

TEST_CASE("an interrupted run keeps its last state", "[simulation]") {
  Simulation simulation(column());
  std::vector<double> times;
  const RunOutcome outcome = run(simulation, {.frame = {},
                                              .history = [&](const auto& row) { times.push_back(row[0]); },
                                              .progress = {},
                                              .interrupted = [&] { return simulation.step() == 7; }});
  CHECK(outcome.status == RunStatus::interrupted);
  CHECK_THAT(outcome.message, Catch::Contains("stopped"));
  CHECK(simulation.step() == 7);
  CHECK(times.back() == simulation.time());
}

TEST_CASE("soil that leaves the body ends the run, if the case says so", "[simulation]") {
  Case scene = box_of_soil(4, 4);
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "thrown";
  scene.soils[1].polygon = box_outline(0, 2.5, 2, 3.5);  // within each other's support
  scene.soils[1].velocity = {0, 20};
  scene.loading.gravity_applied = false;
  scene.soils[0].youngs_modulus = scene.soils[1].youngs_modulus = 1e6;
  scene.time.end = 1;
  scene.stop.on_separation = GENERATE(true, false);
  scene.formulation.motion = Motion::proposed;
  Simulation simulation(scene);
  const RunOutcome outcome = run(simulation, {});
  CHECK((outcome.status == RunStatus::unstable) == scene.stop.on_separation);
  if (scene.stop.on_separation) CHECK_THAT(outcome.message, Catch::Contains("left the soil body"));
  CHECK(simulation.showable());
}

TEST_CASE("errors are taken against the exact column", "[simulation]") {
  Case scene = column();
  scene.reference = Reference::column;
  const auto unstressed = reference_errors(Simulation(scene));
  CHECK(unstressed.at("EffectiveStress_YY").relative_l2 == Approx(1));
  CHECK(unstressed.at("Displacement_Y").relative_l2 == Approx(1));
  CHECK(unstressed.at("EffectiveStress_YY").max_abs == Approx((20e3 - 9810) * 2.75).epsilon(0.01));

  scene.loading.k0_stress = true;  // right but for the settlement's effect on buoyancy
  const auto at_k0 = reference_errors(Simulation(scene));
  CHECK(at_k0.at("EffectiveStress_YY").relative_l2 < 0.005);
  CHECK(at_k0.at("EffectiveStress_YY").relative_l2 > 1e-5);
  CHECK(at_k0.at("EffectiveStress_XX").relative_l2 < 0.005);
  CHECK(at_k0.at("EffectiveStress_ZZ").relative_l2 < 0.005);

  scene.reference = Reference::conventional_column;
  CHECK(reference_errors(Simulation(scene)).at("EffectiveStress_YY").relative_l2 > 0.3);
}

TEST_CASE("no errors without a reference, and none against a column of several soils", "[simulation]") {
  Case scene = column();
  CHECK(reference_errors(Simulation(scene)).empty());
  scene.reference = Reference::column;
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].polygon = box_outline(0, 3, 2, 4);
  CHECK_THROWS_WITH(reference_errors(Simulation(scene)), Catch::Contains("one soil"));
}
