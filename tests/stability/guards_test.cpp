// Breakdown is found soon, said in words, and the last good state is kept.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/case/known_limits.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/stability/scenes.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

struct Ending {
  RunOutcome outcome;
  std::int64_t steps = 0;
  std::vector<std::int64_t> frames;
  std::optional<Breakdown> breakdown;
};

Ending run_of(const Case& scene) {
  Simulation s(scene);
  Ending e;
  e.outcome = run(s, {.frame =
                          [&](Simulation& now) {
                            e.frames.push_back(now.step());
                            for (const Vec2& v : now.velocities()) CHECK(v.norm() < now.model().wave_speed);
                          },
                      .history = {},
                      .progress = {},
                      .interrupted = {}});
  e.steps = s.step(), e.breakdown = s.instability();
  return e;
}

/// A bed on a fixed bottom, and one particle that flies on to it.
Case lone_particle(Motion motion) {
  Case scene = box_of_soil(8, 4, 0.1);
  scene.loading.gravity_applied = false;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {0.8, 0});
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "grain";
  scene.soils[1].polygon = box_outline(0.35, 1, 0.45, 1.1);
  scene.soils[1].velocity = {0, -2};
  scene.formulation = default_formulation(motion);
  scene.stop.on_separation = false;
  scene.time.courant = 0.2;
  scene.time.end = 0.3;
  return scene;
}

}  // namespace

TEST_CASE("a lone particle that lands on a bed does not blow up the run") {
  const Motion motion =
      GENERATE(Motion::consistent, Motion::proposed, Motion::conventional, Motion::rho_squared);
  const double courant = motion == Motion::consistent ? GENERATE(0.2, 0.6, 0.9) : 0.2;
  CAPTURE(motion_name(motion), courant);
  Case scene = lone_particle(motion);
  scene.time.courant = courant;
  Simulation s(scene);
  const double at_start = s.energy().kinetic;
  while (s.step() < s.last_step()) s.advance();
  CHECK_FALSE(s.instability());
  CHECK(s.energy().kinetic + s.energy().elastic < 1.05 * at_start);
}

TEST_CASE("a late breakdown is found within a few hundred steps and the last good state is shown") {
  Case scene =
      shipped_case("foundation", {"particles.spacing=0.5", "time.courant=1.2", "loading.damping=0.1"});
  const Ending e = run_of(scene);
  REQUIRE(e.outcome.status == RunStatus::unstable);
  CHECK(e.steps < 600);
  CHECK_THAT(e.outcome.message, Contains("particle ") && Contains("(from x = ") && Contains("time.courant"));
  REQUIRE(e.frames.size() >= 2);
  CHECK(e.frames.back() > 0);
  CHECK(e.frames.back() + 400 >= e.steps);
}

TEST_CASE("energy from nowhere is named") {
  const Ending e = run_of(shipped_case(
      "verification/column", {"particles.spacing=0.5", "formulation.motion=proposed",
                              "loading.damping=0.1695", "formulation.artificial_viscosity_alpha=0",
                              "loading.damping_until=1.5", "time.end=60", "stop.unbalanced_force_ratio=0"}));
  REQUIRE(e.breakdown);
  CHECK(e.breakdown->cause == Cause::energy_gain);
  CHECK(e.breakdown->time > 1.5);
  CHECK_THAT(e.outcome.message, Contains("came from nowhere") && Contains("artificial_viscosity_alpha"));
}

TEST_CASE("soil that is turned inside out is named") {
  Model model = build_model(box_of_soil(6, 4));
  Particles& p = model.particles;
  CHECK(closest_distance(p.position, 2) == Approx(0.5));
  CHECK_FALSE(find_crossing(model, 0.1, 0.5));
  p.position[8] = p.position[9] + Vec2(0.01, 0);
  const auto crossing = find_crossing(model, 0.1, 0.5);
  REQUIRE(crossing);
  CHECK(crossing->cause == Cause::inverted);
  CHECK_THAT(crossing->message,
             Contains("particle 8 ") && Contains("particle 9 met") && Contains("youngs_modulus"));
  p.density[3] = -1;
  const auto crushed = find_runaway(model, 0.5);
  REQUIRE(crushed);
  CHECK(crushed->cause == Cause::inverted);
  CHECK_THAT(crushed->message, Contains("around particle 3 ") && Contains("inside out"));
}

TEST_CASE("particles that are thrown off are named as such, though they end up fast") {
  const Ending e = run_of(shipped_case(
      "foundation", {"formulation.motion=conventional", "soil.0.no_tension=true", "particles.spacing=0.25"}));
  REQUIRE(e.breakdown);
  CHECK(e.breakdown->cause == Cause::separated);
  CHECK_THAT(e.outcome.message, Contains("have left the soil body") && Contains("formulation.motion"));
}

TEST_CASE("settings that the maps know to fail are named before the run, others are not") {
  const auto warning = [](const std::string& name, const std::vector<std::string>& settings) {
    const auto all = known_failures(shipped_case(name, settings));
    return all.size() == 1 ? all[0] : std::to_string(all.size()) + " warnings";
  };
  for (const std::string name : {"foundation", "embankment", "embankment_layered"})
    CHECK(known_failures(shipped_case(name)).empty());
  CHECK_THAT(warning("foundation", {"time.courant=1.2"}), Contains("time.courant = 1.2"));
  CHECK_THAT(warning("foundation", {"formulation.zero_energy_control=0.5", "time.courant=0.9"}),
             Contains("zero_energy_control"));
  CHECK_THAT(warning("foundation", {"formulation.motion=conventional"}), Contains("5 m above the ground"));
  CHECK(known_failures(shipped_case("foundation", {"formulation.motion=conventional", "water.level=5"}))
            .empty());
  CHECK_THAT(warning("verification/layers", {"formulation.motion=rho_squared"}),
             Contains("density ratio of 0.4"));
  CHECK_THAT(warning("foundation", {"formulation.motion=proposed", "formulation.artificial_viscosity_alpha=0",
                                    "loading.damping=0", "time.end=30"}),
             Contains("without damping"));
  CHECK_THAT(warning("foundation", {"particles.arrangement=disordered", "particles.disorder=0.2",
                                    "formulation.motion=proposed"}),
             Contains("disorder"));
  CHECK(known_failures(
            shipped_case("foundation", {"particles.arrangement=disordered", "particles.disorder=0.4"}))
            .empty());
}
