// Walls with friction: a block on an incline slides or stays, as Coulomb says.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double gravity = 9.81, degree = std::numbers::pi / 180;

/// A block of 1 m x 0.4 m of stiff elastic soil on a wall that rises to the left at this angle [degrees].
Case block(double angle, double coefficient, double spacing, Arrangement arrangement) {
  Case scene = box_of_soil(2, 2, spacing);
  const double c = std::cos(angle * degree), s = std::sin(angle * degree);
  const Point along(c, -s), up(s, c), corner(0, 2);
  SoilCase& soil = scene.soils[0];
  soil.polygon = {corner, corner + along, corner + along + 0.4 * up, corner + 0.4 * up};
  soil.youngs_modulus = 5e6, soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20e3;
  scene.boundaries.push_back({.kind = BoundaryKind::friction,
                              .from = corner - 0.5 * along,
                              .to = corner + 3 * along,
                              .coefficient = coefficient});
  scene.particles.arrangement = arrangement;
  scene.particles.smoothing_ratio = arrangement == Arrangement::stretched ? 1 : 1.2;
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.bulk_viscosity = 0.5;
  scene.loading.adaptive_damping = true, scene.loading.damping_until = 0.1;  // of the bounce by its weight
  scene.time.courant = 0.5;
  return scene;
}

/// Mean velocity and displacement along the wall, downhill.
struct Motion2 {
  double velocity = 0, way = 0;
};
Motion2 downhill(const Simulation& simulation, double angle) {
  const Point along(std::cos(angle * degree), -std::sin(angle * degree));
  const Particles& p = simulation.model().particles;
  Motion2 m;
  double mass = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    m.velocity += p.mass[a] * p.velocity[a].dot(along);
    m.way += p.mass[a] * (p.position[a] - p.start[a]).dot(along);
    mass += p.mass[a];
  }
  return {m.velocity / mass, m.way / mass};
}

void run_until(Simulation& simulation, double time) {
  while (simulation.time() < time && !simulation.instability()) simulation.advance();
  REQUIRE_FALSE(simulation.instability());
}

}  // namespace

TEST_CASE("a block slides down a rough wall with g (sin - mu cos)", "[friction]") {
  const auto [angle, mu] =
      GENERATE(table<double, double>({{20, 0.2}, {30, 0.2}, {30, 0.5}, {0.0, 0.0}, {35, 0}}));
  const auto arrangement = GENERATE(Arrangement::stretched, Arrangement::lattice);
  if (arrangement == Arrangement::lattice && angle != 30) return;
  CAPTURE(angle, mu);
  Case scene = block(angle, mu, 0.05, arrangement);
  scene.time.end = 0.5;
  Simulation simulation(scene);
  run_until(simulation, 0.15);
  const double v0 = downhill(simulation, angle).velocity, t0 = simulation.time();
  run_until(simulation, 0.45);
  const double a = (downhill(simulation, angle).velocity - v0) / (simulation.time() - t0);
  const double expected = gravity * (std::sin(angle * degree) - mu * std::cos(angle * degree));
  // The rows are not along the wall.
  const double part = arrangement == Arrangement::lattice ? 0.017 : 0.008;
  CHECK(a == Approx(expected).margin(part * mu * gravity * std::cos(angle * degree) +
                                     1e-3 * gravity * std::sin(angle * degree) + 1e-9));
}

namespace {

/// As above on a level wall, with an acceleration of `pull` g beside gravity in place of the wall's angle.
Case pulled_block(double pull, double coefficient) {
  Case scene = block(0, coefficient, 0.05, Arrangement::stretched);
  scene.loading.horizontal = pull;
  return scene;
}

}  // namespace

TEST_CASE("the friction of a block is the coefficient times its weight", "[friction]") {
  const double mu = GENERATE(0.2, 0.5), pull = 0.577;
  Case scene = pulled_block(pull, mu);
  scene.time.end = 0.5;
  Simulation simulation(scene);
  run_until(simulation, 0.15);
  const double v0 = downhill(simulation, 0).velocity, t0 = simulation.time();
  run_until(simulation, 0.45);
  const double a = (downhill(simulation, 0).velocity - v0) / (simulation.time() - t0);
  CHECK(pull - a / gravity == Approx(mu).epsilon(0.001));
}

TEST_CASE("a block slides where it is pulled by 1 % more than friction bears", "[friction]") {
  const double share = GENERATE(0.99, 1.01), mu = 0.4;
  Case scene = pulled_block(share * mu, mu);
  scene.loading.damping_until = 0.3;
  scene.time.end = 1.1;
  Simulation simulation(scene);
  run_until(simulation, 0.5);
  const double first = downhill(simulation, 0).way;
  run_until(simulation, 1);
  const double way = downhill(simulation, 0).way - first;
  CAPTURE(share, way);
  // From rest at 0.3 s: 0.5 (0.7^2 - 0.2^2) (share - 1) mu g t^2
  if (share < 1)
    CHECK(std::abs(way) < 1e-6);
  else
    CHECK(way > 0.5 * 0.5 * 0.45 * (share - 1) * mu * gravity);
}

TEST_CASE("below the angle of friction a block stays", "[friction]") {
  const double angle = GENERATE(15.0, 25.0), mu = std::tan((angle + 5) * degree);
  Case scene = block(angle, mu, 0.05, Arrangement::stretched);
  scene.loading.damping_until = never;
  scene.time.end = 1;
  Simulation simulation(scene);
  run_until(simulation, 0.5);
  const Motion2 first = downhill(simulation, angle);
  run_until(simulation, 0.95);
  const Motion2 later = downhill(simulation, angle);
  CHECK(std::abs(later.velocity) < 1e-6);
  CHECK(std::abs(later.way - first.way) < 1e-7);  // it does not creep
  CHECK(first.way < 2e-3);
}

TEST_CASE("the shipped block slides as Coulomb says", "[friction]") {
  Simulation simulation(scene("sliding_block"));
  run_until(simulation, 0.15);
  const double v0 = downhill(simulation, 30).velocity, t0 = simulation.time();
  run_until(simulation, 0.44);
  const double a = (downhill(simulation, 30).velocity - v0) / (simulation.time() - t0);
  expect({.name = "sliding_block",
          .settings = {},
          .quantity = "acceleration",
          .reference = "g (sin(30) - 0.2 cos(30))",
          .resolution = metres(0.05)},
         std::abs(a / (gravity * (0.5 - 0.2 * std::sqrt(0.75))) - 1), 0.01);
}
