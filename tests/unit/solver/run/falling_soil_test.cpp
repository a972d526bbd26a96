// Soil that nothing carries falls, and lands on what is below.
#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"
#include "solver/sph/consistent/flowing_soil.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr double spacing = 0.1, drop = 0.4, strength = 8e3, g = 9.81;

/// Clay on a fixed base between rollers, at rest, and a block of clay 1 m wide and 0.8 m high above it.
Case block_above_clay() {
  Case scene = box_of_soil(40, 10, spacing);
  scene.formulation = default_formulation(Motion::consistent);
  hold_as_column(scene);
  SoilCase block = scene.soils[0];
  block.name = "block";
  block.polygon = box_outline(1.5, 1 + drop, 2.5, 1.8 + drop);
  scene.soils.push_back(block);
  for (SoilCase& soil : scene.soils) {
    soil.law = LawKind::tresca;
    soil.youngs_modulus = 2e6;
    soil.strength.undrained_strength = strength;
  }
  scene.loading.k0_stress = true;
  scene.time.courant = 0.6;
  return scene;
}

struct Block {
  explicit Block(const Simulation& s) {
    const Particles& p = s.model().particles;
    double mass = 0, low = never;
    for (std::size_t a = 0; a < p.size(); ++a) {
      if (p.soil[a] == 0) {
        ground_moved = std::max(ground_moved, p.displacement(a).norm());
        ground_stress = std::min(ground_stress, p.stress[a].yy);
        continue;
      }
      fallen -= p.mass[a] * p.displacement(a).y(), aside += p.mass[a] * p.displacement(a).x();
      speed = std::max(speed, p.velocity[a].norm());
      mass += p.mass[a], low = std::min(low, p.position[a].y());
    }
    fallen /= mass, aside /= mass;
    bottom = low - spacing / 2;
  }
  double fallen = 0, aside = 0, speed = 0, bottom = 0;
  double ground_moved = 0, ground_stress = 0;
};

}  // namespace

TEST_CASE("soil that falls has no stress, does not weigh on what is below, and falls freely",
          "[simulation]") {
  Simulation s(block_above_clay());
  const double weight = 18.6e3;
  CHECK(Block(s).ground_stress == Approx(-weight * 0.95).epsilon(1e-9));  // its own, at the lowest row
  while (s.time() < 0.2) s.advance();
  const Block block(s);
  CHECK(block.fallen == Approx(0.5 * g * s.time() * s.time()).epsilon(1e-9));
  CHECK(block.ground_moved < 1e-3);
}

TEST_CASE("a block of clay lands on clay and stays there, as its fall is dissipated", "[simulation]") {
  Case scene = block_above_clay();
  scene.time.end = 1.5;
  Simulation s(scene);
  const double start = s.energy().total();
  while (s.time() < 0.45) s.advance();
  REQUIRE_FALSE(s.instability());
  const Block landed(s);
  CHECK(landed.fallen > drop);
  CHECK(landed.fallen < drop + 0.3);  // it dents the ground
  CHECK(std::abs(landed.aside) < 1e-6);
  while (s.step() < s.last_step() && !s.instability()) s.advance();
  s.look_for_breakdown();
  REQUIRE_FALSE(s.instability());
  const Block rests(s);
  CAPTURE(rests.fallen, rests.bottom, rests.speed);
  CHECK(rests.fallen == Approx(landed.fallen).epsilon(0.1));  // it does not bounce off
  CHECK(s.energy().kinetic < 0.02 * (start - s.energy().gravity));
  const FlowingSoil::Work& work = s.dynamics().flow()->work();
  const double lost = start - s.energy().total();
  CAPTURE(work.plastic, work.control, work.diffusion, work.viscous, work.shift, lost);
  CHECK(work.plastic > 0.8 * lost);
  CHECK(std::abs(work.plastic + work.control + work.diffusion + work.viscous - lost) < 0.05 * lost);
}
