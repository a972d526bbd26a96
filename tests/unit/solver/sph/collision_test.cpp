#include <catch2/catch.hpp>
#include <tuple>

#include "solver/case/case_file.hpp"
#include "solver/run/kept_state.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

TEST_CASE("bodies that were no neighbours at first bounce off each other", "[motion]") {
  Case scene = box_of_soil(6, 4);
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "right";
  scene.soils[1].polygon = box_outline(5, 0, 8, 2);
  scene.soils[0].velocity = {2, 0}, scene.soils[1].velocity = {-2, 0};
  scene.loading.gravity_applied = false;
  scene.time.end = 0.7;
  scene.formulation.motion = GENERATE(Motion::proposed, Motion::consistent);
  scene.formulation.bulk_viscosity = scene.formulation.motion == Motion::consistent ? 0.06 : 0;
  scene.formulation.refresh_strain = 100;  // only the new neighbours call for it
  Simulation simulation(scene);
  double nearest = never;
  while (simulation.step() < simulation.last_step()) {
    simulation.advance();
    const Particles& p = simulation.model().particles;
    Vec2 centre[2] = {Vec2::Zero(), Vec2::Zero()};
    for (std::size_t a = 0; a < p.size(); ++a) centre[p.soil[a]] += p.position[a] / 24;
    nearest = std::min(nearest, centre[1].x() - centre[0].x());
  }
  REQUIRE_FALSE(simulation.instability());
  if (scene.formulation.motion == Motion::proposed) CHECK(simulation.dynamics().counts.refreshes > 1);
  CHECK(nearest > 2.8);  // each is 3 m wide
  CHECK(nearest < 4.3);
  Vec2 momentum[2] = {Vec2::Zero(), Vec2::Zero()};
  const Particles& p = simulation.model().particles;
  for (std::size_t a = 0; a < p.size(); ++a) momentum[p.soil[a]] += p.mass[a] * p.velocity[a];
  CHECK(momentum[0].x() < 0);
  CHECK(momentum[1].x() > 0);
  CHECK((momentum[0] + momentum[1]).norm() < 1e-3 * momentum[0].norm());
}

TEST_CASE("contact of elastic bodies conserves momentum and energy", "[motion]") {
  Case scene = box_of_soil(6, 4);
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "right";
  scene.soils[1].polygon = box_outline(5, 0.7, 8, 2.7);  // offset: they turn
  scene.soils[0].velocity = {2, 0}, scene.soils[1].velocity = {-2, 0};
  scene.soils[1].youngs_modulus = 5e6;
  scene.loading.gravity_applied = false;
  scene.time.end = 1.5;
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.bulk_viscosity = scene.formulation.zero_energy_control = 0;
  Simulation simulation(scene);
  const auto momentum = [&] {
    const Particles& p = simulation.model().particles;
    Vec2 sum = Vec2::Zero(), of_one = Vec2::Zero();
    double turning = 0;
    for (std::size_t a = 0; a < p.size(); ++a) {
      const Vec2 m = p.mass[a] * p.velocity[a];
      sum += m, turning += p.position[a].x() * m.y() - p.position[a].y() * m.x();
      if (p.soil[a] == 0) of_one += m;
    }
    return std::tuple(sum, turning, of_one);
  };
  const auto [sum, turning, first] = momentum();
  const double energy = simulation.energy().total();
  while (simulation.step() < simulation.last_step()) simulation.advance();
  REQUIRE_FALSE(simulation.instability());
  const auto [sum_after, turning_after, first_after] = momentum();
  CHECK((sum_after - sum).norm() < 1e-12 * first.norm());
  CHECK(std::abs(turning_after - turning) < 1e-3 * std::abs(turning));  // leapfrog's half step of vibrations
  CHECK(first_after.x() < -0.3 * first.x());
  CHECK(simulation.energy().total() == Approx(energy).epsilon(0.01));
}

TEST_CASE("a run with contact continues to the same bits from a saved state", "[motion]") {
  Case scene = box_of_soil(4, 4);
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "right";
  scene.soils[1].polygon = box_outline(3.3, 0, 5.3, 2);
  scene.soils[0].velocity = {8, 0};  // they meet after 146 steps
  scene.loading.gravity_applied = false;
  scene.formulation = default_formulation(Motion::consistent);
  Simulation through(scene), resumed(scene);
  for (int k = 0; k < 150; ++k) through.advance();
  const KeptState saved(through);
  for (int k = 0; k < 150; ++k) through.advance();
  saved.restore(resumed);
  for (int k = 0; k < 150; ++k) resumed.advance();
  CHECK(through.model().particles.position == resumed.model().particles.position);
}
