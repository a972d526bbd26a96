#include <catch2/catch.hpp>

#include "solver/run/simulation.hpp"
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
  CHECK(simulation.dynamics().counts.refreshes > 1);
  CHECK(nearest > 2.8);  // each is 3 m wide
  CHECK(nearest < 4.3);
  Vec2 momentum[2] = {Vec2::Zero(), Vec2::Zero()};
  const Particles& p = simulation.model().particles;
  for (std::size_t a = 0; a < p.size(); ++a) momentum[p.soil[a]] += p.mass[a] * p.velocity[a];
  CHECK(momentum[0].x() < 0);
  CHECK(momentum[1].x() > 0);
  CHECK((momentum[0] + momentum[1]).norm() < 1e-3 * momentum[0].norm());
}
