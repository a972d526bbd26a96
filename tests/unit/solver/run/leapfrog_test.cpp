#include "solver/run/leapfrog.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

struct State {
  Vec2 x, v;
};

/// x'' = -omega^2 x - c x' from x = 1 at rest, at t = 1.
State integrated(double omega, double damping, int steps) {
  const double dt = 1.0 / steps;
  Vec2 x(1, 0), v = Vec2::Zero();
  for (int i = 0; i < steps; ++i) {
    const Vec2 a = -omega * omega * x;
    v = (i == 0 ? first_kick : full_kick)(damping, dt)(v, a);
    x += dt * v;
  }
  return {x, half_kick(damping, dt)(v, -omega * omega * x)};
}

State exact(double omega, double damping) {
  const double d = damping / 2, w = std::sqrt(omega * omega - d * d), decay = std::exp(-d);
  return {Vec2(decay * (std::cos(w) + d / w * std::sin(w)), 0),
          Vec2(-decay * omega * omega / w * std::sin(w), 0)};
}

std::vector<Vec2> column_after(double courant, Motion motion) {
  Case scene = box_of_soil(3, 10);
  hold_as_column(scene);
  add_water(scene, 8);
  scene.formulation.motion = motion;
  const Model model = build_model(scene);
  scene.time.end = 30 * 0.8 * model.smoothing_length / model.wave_speed;
  scene.time.courant = courant;
  Simulation simulation(scene);
  while (simulation.step() < simulation.last_step()) simulation.advance();
  CHECK(simulation.last_step() == std::lround(30 * 0.8 / courant));
  CHECK(simulation.time() == Approx(scene.time.end));
  return simulation.model().particles.position;
}

double distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("the leapfrog is of second order in time, damped or not", "[simulation]") {
  const double omega = 7, damping = GENERATE(0.0, 1.5);
  const State truth = exact(omega, damping), coarse = integrated(omega, damping, 200),
              fine = integrated(omega, damping, 400);
  CHECK((coarse.x - truth.x).norm() / (fine.x - truth.x).norm() == Approx(4).margin(0.1));
  CHECK((coarse.v - truth.v).norm() / (fine.v - truth.v).norm() == Approx(4).margin(0.1));
  CHECK((fine.x - truth.x).norm() < 1e-3);
}

TEST_CASE("a column in motion is of second order in time", "[simulation]") {
  const Motion motion = GENERATE(Motion::proposed, Motion::consistent);
  const auto truth = column_after(0.05, motion);
  const double coarse = distance(column_after(0.4, motion), truth),
               fine = distance(column_after(0.2, motion), truth);
  const double second_order = (64.0 - 1) / (16.0 - 1);  // the truth has an error too
  CHECK(coarse / fine == Approx(second_order).margin(0.3));
}

TEST_CASE("damping ends when the case says", "[simulation]") {
  Case scene = box_of_soil(3, 3);
  scene.loading.gravity_applied = false;
  scene.soils[0].velocity = {1, 0};
  scene.loading.damping = 0.1;
  const double dt = Simulation(scene).time_step();
  scene.loading.damping_until = 5.5 * dt;
  Simulation simulation(scene);
  while (simulation.step() < 20) simulation.advance();
  const double damped_steps = 1 - 0.05,
               kick_ratio = (1 - 0.05) / (1 + 0.05);  // the first half step, then steps 1 to 5
  CHECK(simulation.model().particles.velocity[4].x() == Approx(damped_steps * std::pow(kick_ratio, 5)));
}
