// Tension: the colliding rings of Gray, Monaghan and Swift (2001).
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "solver/monitor/instability.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

struct Collision {
  std::int64_t bodies = 0;       ///< at the end
  bool touched = false;
  double speed_after = 0;        ///< of the right ring's centre, over that before
  double energy = 0;             ///< at the end, over that at the start
  double widest_gap = 0;         ///< largest distance from a particle to its nearest neighbour at the end, over spacing
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
  const RunOutcome outcome = run(s, {.progress = [&](const Simulation& now) {
    if (now.step() % 50 == 0 && !c.touched) c.touched = find_bodies(p.position, support).count == 1;
  }});
  UNSCOPED_INFO(outcome.message);
  c.bodies = find_bodies(p.position, 1.7 * s.model().spacing).count;
  c.speed_after = mean_velocity(p, 1) / before;
  c.energy = s.energy().total() / energy;
  return c;
}

}  // namespace

TEST_CASE("rings: measure") {
  for (const Settings& settings : {Settings{}, Settings{"formulation.motion=proposed", "formulation.artificial_viscosity_alpha=1"},
        Settings{"formulation.motion=proposed", "formulation.artificial_viscosity_alpha=1", "formulation.artificial_stress=0.3"},
        Settings{"formulation.motion=proposed", "formulation.artificial_viscosity_alpha=1", "formulation.artificial_stress=0.5"}}) {
    const Collision c = collide(settings);
    WARN((settings.empty() ? "consistent" : settings.back()) << " bodies " << c.bodies << " touched " << c.touched << " speed "
         << c.speed_after << " energy " << c.energy);
  }
}
