#include <catch2/catch.hpp>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Soil of 18.6 (dry) and 20 kN/m3 (wet) from y = 0 to 3 m.
Case level_ground() {
  Case scene = box_of_soil(4, 6);
  scene.loading.k0_stress = true;
  return scene;
}

double vertical(const Case& scene, double y) { return k0_stress(scene, {1.1, y}, 0.5).yy; }

}  // namespace

TEST_CASE("K0 stress of dry soil is its weight", "[model]") {
  CHECK(vertical(level_ground(), 1) == Approx(-18.6e3 * 2));
  CHECK(vertical(level_ground(), 3) == Approx(0).margin(1e-9));
  const Stress s = k0_stress(level_ground(), {1.1, 1}, 0.4);
  CHECK(s.xx == Approx(0.4 * s.yy));
  CHECK(s.zz == Approx(0.4 * s.yy));
  CHECK(s.xy == 0);
}

TEST_CASE("K0 stress under water is the buoyant weight, however deep the water", "[model]") {
  Case scene = level_ground();
  add_water(scene, GENERATE(3.0, 8.0, 100.0));
  CHECK(vertical(scene, 1) == Approx(-(20e3 - 9810) * 2));
  CHECK(vertical(scene, 3) == Approx(0).margin(1e-9));
}

TEST_CASE("K0 stress with the water level in the ground", "[model]") {
  Case scene = level_ground();
  add_water(scene, 2);
  CHECK(vertical(scene, 2.5) == Approx(-18.6e3 * 0.5));
  CHECK(vertical(scene, 1) == Approx(-(18.6e3 + (20e3 - 9810))));
}

TEST_CASE("K0 stress adds up layers", "[model]") {
  Case scene = level_ground();
  SoilCase clay = scene.soils[0];
  clay.name = "clay";
  clay.polygon = box_outline(0, 3, 2, 4);
  clay.unit_weight_saturated = 15e3, clay.unit_weight_unsaturated = 12e3, clay.poissons_ratio = 0.2;
  scene.soils.push_back(clay);
  CHECK(vertical(scene, 1) == Approx(-(12e3 + 2 * 18.6e3)));
  add_water(scene, 3.25);
  CHECK(vertical(scene, 1) == Approx(-(0.75 * 12e3 + 0.25 * 15e3 + 2 * 20e3) + 9810 * 2.25));

  const Model model = build_model(scene);  // k0 of each soil: nu / (1 - nu)
  const Stress &lower = model.particles.stress.front(), &upper = model.particles.stress.back();
  CHECK(lower.xx == Approx(0.33 / 0.67 * lower.yy));
  CHECK(upper.xx == Approx(0.25 * upper.yy));
  CHECK(upper.yy == Approx(-0.25 * 12e3));
}

TEST_CASE("K0 stress leaves out a hole above the point", "[model]") {
  Case scene = level_ground();
  scene.soils[0].holes = {box_outline(0.5, 1.5, 1.5, 2)};
  CHECK(vertical(scene, 1) == Approx(-18.6e3 * 1.5));
}

TEST_CASE("a model is a case in SI units", "[model]") {
  Case scene = box_of_soil(4, 6);
  add_water(scene, 1.5);
  const Model model = build_model(scene);
  const Particles& p = model.particles;
  REQUIRE(p.size() == 24);
  CHECK(p.density[0] == Approx(20e3 / 9.81));
  CHECK(p.density[23] == Approx(18.6e3 / 9.81));
  CHECK(p.mass[0] == Approx(20e3 / 9.81 * 0.25));
  CHECK(p.pore_pressure[0] == Approx(-9810 * 1.25));
  CHECK(p.pore_pressure[23] == 0);
  CHECK(model.smoothing_length == Approx(0.6));
  CHECK(model.gravity == Vec2(0, -9.81));
  CHECK(model.wave_speed == Approx(std::sqrt(model.soils[0].constrained_modulus() / p.density[23])));
  CHECK(p.stress[0].yy == 0);
}

TEST_CASE("a stretch of water ends where it says", "[model]") {
  const StandingWater water(
      {.unit_weight = 10e3, .stretches = {{0, 2, 5}, {3, 4, 1}}, .level_over_time = {}});
  CHECK(water.pore_pressure(1, 2) == -30e3);
  CHECK(water.pore_pressure(3.5, 2) == 0);
  CHECK(water.pore_pressure(2.5, -9) == 0);
  CHECK(water.depth(2.5, 0) == -never);
  CHECK(water.depth(3.5, 2) == -1);
}
