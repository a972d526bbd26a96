#include "app/bench/timed_run.hpp"

#include <omp.h>

#include <catch2/catch.hpp>

#include "app/bench/bench.hpp"
#include "app/bench/strategies.hpp"
#include "app/bench/timed_dynamics.hpp"
#include "solver/run/reference_errors.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using namespace porosph::bench;

namespace {

Case column() {
  Case scene = box_of_soil(3, 8);
  add_water(scene, 5);
  hold_as_column(scene);
  scene.reference = Reference::column;
  scene.formulation = {.motion = Motion::proposed};
  scene.formulation.artificial_viscosity_alpha = 0.1;
  scene.loading.damping = 0.1;
  scene.time.courant = 0.5;
  scene.stop.unbalanced_force_ratio = 1e-3;
  return scene;
}

}  // namespace

TEST_CASE("A timed run ends where a run does, at the error that the run tells of") {
  omp_set_num_threads(1);
  Simulation simulation(column());
  const RunOutcome outcome = run(simulation, {});
  const TimedRun timed = timed_run(column(), make_dynamics, nullptr);
  REQUIRE(outcome.status == RunStatus::equilibrium);
  CHECK(timed.ending == "equilibrium");
  CHECK(timed.particles == 24);
  CHECK(timed.steps == simulation.step());
  CHECK(timed.error ==
        Approx(reference_errors(simulation).at("EffectiveStress_YY").relative_l2).epsilon(1e-12));
  CHECK(timed.settled > 0);
  CHECK(timed.settled <= timed.seconds);
}

TEST_CASE("The plain loops come to the same rest") {
  const TimedRun fast = timed_run(column(), make_dynamics, nullptr),
                 plain = timed_run(column(), make_plain_dynamics, nullptr);
  CHECK(plain.steps == fast.steps);
  CHECK(plain.error == Approx(fast.error).epsilon(1e-9));
}

TEST_CASE("Timing the dynamics changes nothing") {
  CallTimes times;
  Simulation timed(column(), [&](const FormulationCase& f, Model& model) -> std::unique_ptr<Dynamics> {
    return std::make_unique<TimedDynamics>(make_dynamics(f, model), times);
  });
  Simulation usual(column());
  for (int i = 0; i < 20; ++i) timed.advance(), usual.advance();
  for (std::size_t i = 0; i < 24; ++i)
    CHECK(timed.model().particles.velocity[i] == usual.model().particles.velocity[i]);
  CHECK(timed.dynamics().counts.refreshes == usual.dynamics().counts.refreshes);
  CHECK(times.prepare.cpu > 0);
  CHECK(times.accelerations.cpu > 0);
  CHECK(times.strain.cpu > 0);
}

TEST_CASE("Every planned run is a case") {
  BenchOptions options;
  options.cases = std::filesystem::path(POROSPH_SOURCE_DIR) / "cases";
  const Bench bench(options);
  for (bool quick : {true, false})
    for (const Plan& plan : plans(quick)) {
      CAPTURE(plan.scene.name, plan.form, plan.strategy, plan.spacing);
      CHECK_NOTHROW(read(bench, plan.file(), plan.overrides()));
    }
}
