#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/monitor/energy.hpp"
#include "solver/run/monitor/instability.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

TEST_CASE("bodies are what hangs together within the support", "[monitor]") {
  const std::vector<Vec2> points = {{0, 0}, {5, 0}, {0.9, 0}, {1.8, 0}, {5, 0.9}, {20, 20}};
  const Bodies bodies = find_bodies(points, 1);
  CHECK(bodies.count == 3);
  CHECK(bodies.body == std::vector<std::int32_t>{0, 1, 0, 0, 1, 2});
  CHECK(find_bodies(points, 0.5).count == 6);
  CHECK(find_bodies(points, 100).count == 1);
}

TEST_CASE("separation names the particle that left", "[monitor]") {
  Model model = build_model(box_of_soil(6, 4));
  CHECK_FALSE(find_separation(model, 1, 0.5));
  model.particles.position[13] += Vec2(0, 30);
  const auto message = find_separation(model, 1, 0.5);
  REQUIRE(message);
  CHECK_THAT(message->message,
             Catch::Contains("particle 13 ") && Catch::Contains("0.5 s") && Catch::Contains("0 more"));
  CHECK_FALSE(find_separation(model, 2, 0.5));
}

TEST_CASE("a runaway is named with its place of origin", "[monitor]") {
  Model model = build_model(box_of_soil(6, 4));
  CHECK_FALSE(find_runaway(model, 0.5));
  model.particles.velocity[7] = Vec2(0, 1.01 * model.wave_speed);
  CHECK_THAT(find_runaway(model, 0.5).value().message,
             Catch::Contains("particle 7 (from x = 0.750 m, y = 0.750 m)"));
  model.particles.stress[3].zz = std::nan("");
  CHECK_THAT(find_runaway(model, 0.5).value().message,
             Catch::Contains("particle 3 ") && Catch::Contains("not finite") ||
                 Catch::Contains("particle 3 ") && Catch::Contains("no longer"));
}

TEST_CASE("energies of a simple state", "[monitor]") {
  Case scene = box_of_soil(4, 2);
  add_water(scene, 10);
  Model model = build_model(scene);
  Particles& p = model.particles;
  const double mass = 2 * 20e3 / 9.81, area = 2;  // 2 m x 1 m

  std::vector<Vec2> velocity(p.size(), Vec2(3, 4));
  CHECK(kinetic_energy(p, velocity) == Approx(0.5 * mass * 25));

  const Elasticity& soil = model.soils[0].elastic();
  const double strain = -2e-3, lambda = soil.bulk_modulus - 2 * soil.shear_modulus / 3;
  for (Stress& s : p.stress) s = {lambda * strain, soil.constrained_modulus() * strain, lambda * strain, 0};
  CHECK(elastic_energy(model) == Approx(0.5 * soil.constrained_modulus() * strain * strain * area));
  for (Stress& s : p.stress) s = {.xy = 5e3};
  CHECK(elastic_energy(model) == Approx(5e3 * 5e3 / (2 * soil.shear_modulus) * area));

  CHECK(gravity_energy(model) == 0);
  CHECK(water_energy(model) == Approx(0).margin(1e-9));
  for (std::size_t a = 0; a < p.size(); ++a) {
    p.position[a].y() -= 0.1;
    p.pore_pressure[a] = model.water.pore_pressure(p.position[a].x(), p.position[a].y());
  }
  CHECK(gravity_energy(model) == Approx(-mass * 9.81 * 0.1));
  CHECK(water_energy(model) == Approx(9810 * 0.1 * area));
}

TEST_CASE("the unbalanced force ratio is one where nothing holds the weight", "[monitor]") {
  Case scene = box_of_soil(4, 2);
  Model model = build_model(scene);
  const std::vector<Vec2> falling(model.particles.size(), model.gravity);
  CHECK(unbalanced_force_ratio(model, falling) == Approx(1));
  model.gravity = Vec2::Zero();
  CHECK(std::isinf(unbalanced_force_ratio(model, falling)));
}

namespace {

struct Balance {
  double exchanged = 0, off = 0;  // largest change of the kinetic energy, and of all of it
};

Balance balance(const Case& scene) {
  Simulation simulation(scene);
  const Simulation::Energy start = simulation.energy();
  Balance b;
  while (simulation.step() < simulation.last_step()) {
    simulation.advance();
    const Simulation::Energy now = simulation.energy();
    b.exchanged = std::max(b.exchanged, std::abs(now.kinetic - start.kinetic));
    b.off = std::max(b.off, std::abs(now.total() - start.total()));
  }
  return b;
}

}  // namespace

TEST_CASE("a free body that vibrates keeps its energy", "[monitor]") {
  Case scene = box_of_soil(8, 4);
  scene.loading.gravity_applied = false;
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "upper", scene.soils[1].polygon = box_outline(0, 2, 4, 4);
  scene.soils[0].velocity = {0, 0.1}, scene.soils[1].velocity = {0, -0.1};
  scene.time.end = 0.5;
  scene.formulation.refresh_strain = GENERATE(0.0, 0.1);
  const Balance b = balance(scene);
  CHECK(b.exchanged > 0.5 * 0.5 * 16 * 18.6e3 / 9.81 * 0.01);  // half of what there was
  CHECK(b.off < 0.01 * b.exchanged);
}

TEST_CASE("a column that swings in still water keeps its energy, but for what its coarse wall takes",
          "[monitor]") {
  Case scene = box_of_soil(4, 12);
  hold_as_column(scene);
  add_water(scene, 8);
  scene.time.end = 0.3;
  const Balance coarse = balance(scene);
  CHECK(coarse.exchanged > 300);
  CHECK(coarse.off < 0.05 * coarse.exchanged);

  scene = box_of_soil(4, 48, 0.125);
  hold_as_column(scene);
  add_water(scene, 8);
  scene.time.end = 0.3;
  const Balance fine = balance(scene);
  CHECK(fine.off / fine.exchanged < 0.4 * coarse.off / coarse.exchanged);
}

TEST_CASE("unbalanced forces count by mass, over the weight of all", "[monitor]") {
  Model model = build_model(box_of_soil(2, 1));
  model.particles.mass = {1, 3};
  model.gravity = Vec2(0, -10);
  const std::vector<Vec2> accelerations = {Vec2(3, 4), Vec2(0, -2)};
  // forces of 5 and 6 N, weights of 10 and 30 N
  CHECK(unbalanced_force_ratio(model, accelerations) == Approx(std::sqrt((25. + 36) / (100 + 900))));
  model.gravity = Vec2(6, -8);  // of the same size
  CHECK(unbalanced_force_ratio(model, accelerations) == Approx(std::sqrt((25. + 36) / (100 + 900))));
  model.gravity = Vec2::Zero();
  CHECK(std::isinf(unbalanced_force_ratio(model, accelerations)));
}
