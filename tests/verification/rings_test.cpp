// Tension: the colliding rings of Gray, Monaghan and Swift (2001).
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "solver/run/monitor/instability.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

struct Collision {
  std::int64_t bodies = 0;  ///< at the end
  bool completed = false;
  bool touched = false;
  double speed_after = 0;  ///< of the right ring's centre, over that before
  double energy = 0;       ///< at the end, over that at the start
};

double mean_velocity(const Particles& p, int soil) {
  double momentum = 0, mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.soil[i] == soil) momentum += p.mass[i] * p.velocity[i].x(), mass += p.mass[i];
  return momentum / mass;
}

Collision collide(const Settings& settings) {
  Simulation s(scene("rings", settings));
  const Particles& p = s.model().particles;
  const double support = 2 * s.model().smoothing_length;
  Collision c;
  REQUIRE(find_bodies(p.position, support).count == 2);
  const double before = mean_velocity(p, 1), energy = s.energy().total();
  RunWatch watch;
  watch.progress = [&](const Simulation& now) {
    if (now.step() % 50 == 0 && !c.touched) c.touched = find_bodies(p.position, support).count == 1;
  };
  const RunOutcome outcome = run(s, watch);
  c.completed = outcome.status == RunStatus::completed;
  c.bodies = find_bodies(p.position, 1.7 * s.model().spacing).count;
  c.speed_after = mean_velocity(p, 1) / before;
  c.energy = s.energy().total() / energy;
  return c;
}

}  // namespace

TEST_CASE("rings: with artificial stress the proposed form lets them bounce whole") {
  const Settings settings = {"time.end=0.025", "formulation.motion=proposed",
                             "formulation.artificial_viscosity_alpha=1", "formulation.artificial_stress=0.5"};
  const Collision c = collide(settings);
  CHECK(c.completed);
  CHECK(c.touched);
  CHECK(c.bodies == 2);
  CHECK(c.energy < 1);
  CHECK(c.speed_after < -0.5);
  note({"rings", settings, "bodies after the collision, proposed form with artificial stress",
        "two whole rings", "6 particles over the wall"},
       fmt::format("{}, {:.2f} of the speed regained", c.bodies, -c.speed_after), "2, above 0.5");
}

TEST_CASE("rings: without artificial stress the proposed form breaks them") {
  const Settings settings = {"time.end=0.025", "formulation.motion=proposed",
                             "formulation.artificial_viscosity_alpha=1"};
  const Collision c = collide(settings);
  CHECK(c.touched);
  CHECK((c.bodies > 2 || !c.completed));
  note({"rings", settings, "bodies after the collision, proposed form without artificial stress",
        "two whole rings", "6 particles over the wall"},
       fmt::format("{} pieces{}", c.bodies, c.completed ? "" : ", unstable"),
       "must break: more than 2, or unstable");
}

TEST_CASE("rings: in the consistent form they bounce whole, at any spacing") {
  const double spacing = GENERATE(0.0016, 0.0012);
  const Settings settings = spacing < 0.0016 ? Settings{"particles.spacing=0.0012"} : Settings{};
  const Collision c = collide(settings);
  CHECK(c.completed);
  CHECK(c.touched);
  CHECK(c.bodies == 2);
  CHECK(c.energy < 1);
  CHECK(c.energy > 0.5);
  CHECK(c.speed_after < -0.5);
  note({"rings", settings, "bodies after the collision, consistent form", "two whole rings",
        fmt::format("{:.0f} particles over the wall", 0.01 / spacing)},
       fmt::format("{}, {:.2f} of the speed regained", c.bodies, -c.speed_after), "2, above 0.5");
}
