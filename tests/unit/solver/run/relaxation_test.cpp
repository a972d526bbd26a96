#include "solver/run/relaxation.hpp"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Bodies on springs, omega^2 each [1/s2]: accelerations before and after a step with these velocities.
struct Springs {
  Particles bodies;
  std::vector<Vec2> before, after;

  void add(double omega, const Vec2& velocity, double dt) {
    bodies.position.push_back(Vec2::Zero());
    bodies.mass.push_back(2);
    bodies.velocity.push_back(velocity);
    before.push_back(Vec2(3, 4));
    after.push_back(before.back() - omega * omega * dt * velocity);
  }
};

Case column() {
  Case scene = box_of_soil(8, 12);
  hold_as_column(scene);
  scene.time = {.end = 20, .courant = 0.9};
  scene.formulation = {.bulk_viscosity = 0.06, .zero_energy_control = 0.05, .refresh_strain = 0.05};
  scene.loading.adaptive_damping = true;
  scene.stop.unbalanced_force_ratio = 1e-6;
  return scene;
}

double largest_difference(const Simulation& a, const Simulation& b) {
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.model().particles.size(); ++i) {
    const Stress &s = a.model().particles.stress[i], &t = b.model().particles.stress[i];
    difference = std::max({difference, std::abs(s.xx - t.xx), std::abs(s.yy - t.yy), std::abs(s.xy - t.xy)});
    largest = std::max(largest, std::abs(s.yy));
  }
  return difference / largest;
}

}  // namespace

TEST_CASE("relaxation damps one vibration critically", "[relaxation]") {
  const double dt = 1e-3;
  Springs springs;
  springs.add(7, {0.3, -0.2}, dt);
  Relaxation relaxation;
  relaxation.measure(springs.bodies, springs.before, springs.after, dt);
  CHECK(relaxation.damping == Approx(2 * 7));
  relaxation.measure(springs.bodies, springs.before, springs.after, dt);
  CHECK(relaxation.damping == Approx(2 * 7));
}

TEST_CASE("relaxation weighs vibrations by their energy and forgets those that died out", "[relaxation]") {
  const double dt = 1e-2;
  Springs both;
  both.add(2, {1, 0}, dt);
  both.add(6, {1, 0}, dt);
  Relaxation relaxation;
  relaxation.measure(both.bodies, both.before, both.after, dt);
  CHECK(relaxation.damping == Approx(2 * std::sqrt((4 + 36) / 2.0)));
  Springs low;
  low.add(2, {1, 0}, dt);
  low.add(6, {0, 0}, dt);
  for (int i = 0; i < 400; ++i) relaxation.measure(low.bodies, low.before, low.after, dt);
  CHECK(relaxation.damping == Approx(2 * 2).epsilon(1e-3));
}

TEST_CASE("relaxation remembers the last 1 / omega", "[relaxation]") {
  const double dt = 1e-2, before = 7, now = 3;
  Springs first, second;
  first.add(before, {0.3, -0.2}, dt);
  second.add(now, {0.3, -0.2}, dt);
  Relaxation relaxation;
  relaxation.measure(first.bodies, first.before, first.after, dt);
  relaxation.measure(second.bodies, second.before, second.after, dt);
  // what was measured five steps ago has faded by exp(-omega * 5 dt)
  const double kept = std::exp(-before * 5 * dt);
  const double omega_squared = (kept * before * before + now * now) / (kept + 1);
  CHECK(relaxation.damping == Approx(2 * std::sqrt(omega_squared)).epsilon(1e-10));
}

TEST_CASE("relaxation stays finite at rest, where a body softens, and where it is too stiff",
          "[relaxation]") {
  const double dt = 1e-2;
  Springs springs;
  springs.add(5, {0, 0}, dt);
  Relaxation relaxation;
  relaxation.measure(springs.bodies, springs.before, springs.after, dt);
  CHECK(relaxation.damping == 0);

  springs.bodies.velocity[0] = {1, 0};
  springs.after[0] = springs.before[0] + Vec2(1, 0);  // pushed on by its own motion
  relaxation.measure(springs.bodies, springs.before, springs.after, dt);
  CHECK(relaxation.damping == 0);

  Springs stiff;
  stiff.add(1e9, {1, 0}, dt);
  relaxation = {};
  relaxation.measure(stiff.bodies, stiff.before, stiff.after, dt);
  CHECK(relaxation.damping == Approx(1 / dt));
}

TEST_CASE("adaptive damping comes to the same rest as the paper's, in a tenth of the steps", "[relaxation]") {
  Simulation adaptive(column());
  REQUIRE(run(adaptive, {}).status == RunStatus::equilibrium);
  Case scene = column();
  scene.loading.adaptive_damping = false;
  scene.loading.damping = 0.002;
  scene.time.courant = 0.2;
  Simulation paper(scene);
  REQUIRE(run(paper, {}).status == RunStatus::equilibrium);
  CHECK(largest_difference(adaptive, paper) < 1e-4);
  CHECK(10 * adaptive.step() < paper.step());
}

TEST_CASE("adaptive damping does not depend on the number of threads", "[relaxation]") {
  Case scene = column();
  scene.time.end = 0.2;
  Simulation a(scene), b(scene);
  while (a.step() < a.last_step()) a.advance();
  const int threads = omp_get_max_threads();
  omp_set_num_threads(3);
  while (b.step() < b.last_step()) b.advance();
  omp_set_num_threads(threads);
  CHECK(a.damping() > 0);
  CHECK(a.damping() == b.damping());
}
