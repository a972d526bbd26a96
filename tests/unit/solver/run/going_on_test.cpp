// Saved states that simulations go on from, at any instant and whatever was looked at before.
#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/run/kept_state.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Soil without cohesion that collapses along a base and comes off in grains.
Case collapsing(Motion motion, BoundaryKind base) {
  Case scene = box_of_soil(8, 10, 0.01);
  scene.formulation = default_formulation(motion);
  scene.soils[0].law = LawKind::drucker_prager;
  scene.soils[0].youngs_modulus = 0.84e6;
  scene.soils[0].strength.friction_angle = 20;
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 0.2});
  add_wall(scene, base, {0, 0}, {0.5, 0});
  if (base == BoundaryKind::friction) scene.boundaries.back().coefficient = 0.3;
  scene.time.end = 0.3;
  scene.time.courant = 0.6;
  return scene;
}

}  // namespace

TEST_CASE("flowing soil continues to the same bits from any step, with its forces summed or not",
          "[resume]") {
  const Motion motion = GENERATE(Motion::consistent, Motion::proposed);
  const BoundaryKind base = motion == Motion::proposed
                                ? BoundaryKind::fixed
                                : GENERATE(BoundaryKind::fixed, BoundaryKind::friction);
  const Case scene = collapsing(motion, base);
  Simulation through(scene), resumed(scene);
  while (through.time() < 0.15) through.advance();
  for (int step = 0; step < 40; ++step) {
    CAPTURE(step, through.step());
    const bool summed = step % 3 != 0;
    if (summed) through.accelerations();
    KeptState(through).restore(resumed);
    for (int k = 0; k < 5; ++k) through.advance(), resumed.advance();
    REQUIRE_FALSE(through.instability());
    REQUIRE(KeptState(through) == KeptState(resumed));
  }
}
