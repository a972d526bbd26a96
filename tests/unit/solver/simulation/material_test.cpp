// Materials of one's own in the step that is made for linear elasticity.
#include "solver/constitutive/material.hpp"

#include <catch2/catch.hpp>

#include "solver/output/invariants.hpp"
#include "solver/simulation/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Says what linear elasticity says.
struct Elastic final : Material {
  Stress stress(const MaterialStep& step) override { return step.elastic; }
};

/// No more deviatoric stress than a limit [Pa].
struct Limited final : Material {
  Stress stress(const MaterialStep& step) override {
    const double q = von_mises_stress(step.elastic), mean = step.elastic.mean();
    if (q <= limit) return step.elastic;
    const Stress s = deviator(step.elastic) * (limit / q);
    return s + Stress{mean, mean, mean, 0};
  }
  double limit = 5e3;
};

Case spinning_column(Motion motion) {
  Case scene = box_of_soil(6, 8, 0.25);
  hold_as_column(scene);
  add_water(scene, 3);
  scene.formulation.motion = motion;
  scene.soils[0].velocity = Point(0.3, 0);
  return scene;
}

}  // namespace

TEST_CASE("a material that is linear elastic changes nothing but rounding", "[material]") {
  const Case scene = spinning_column(GENERATE(Motion::consistent, Motion::proposed));
  Simulation plain(scene), own(scene);
  own.set_material("soil", std::make_shared<Elastic>());
  for (int i = 0; i < 60; ++i) plain.advance(), own.advance();
  const Particles &a = plain.model().particles, &b = own.model().particles;
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK((a.position[i] - b.position[i]).norm() < 1e-12);
    CHECK(b.stress[i].yy == Approx(a.stress[i].yy).epsilon(1e-8).margin(1e-6));
    CHECK(b.stress[i].xy == Approx(a.stress[i].xy).epsilon(1e-8).margin(1e-6));
  }
}

TEST_CASE("a material's stress is what the particles have after the step", "[material]") {
  const Case scene = spinning_column(GENERATE(Motion::consistent, Motion::proposed));
  Simulation plain(scene), own(scene);
  own.set_material("soil", std::make_shared<Limited>());
  for (int i = 0; i < 100; ++i) plain.advance(), own.advance();
  double most = 0, most_elastic = 0;
  for (const Stress& s : own.model().particles.stress) most = std::max(most, von_mises_stress(s));
  for (const Stress& s : plain.model().particles.stress)
    most_elastic = std::max(most_elastic, von_mises_stress(s));
  CHECK(most_elastic > 10e3);
  CHECK(most == Approx(5e3).epsilon(1e-9));
}

TEST_CASE("a material is given to a soil that there is", "[material]") {
  Case scene = box_of_soil(4, 4);
  Simulation simulation(scene);
  CHECK_THROWS_WITH(simulation.set_material("clay", std::make_shared<Elastic>()), "no soil is called 'clay'");
  scene.soils[0].no_tension = true;
  Simulation without_tension(scene);
  CHECK_THROWS_WITH(without_tension.set_material("soil", std::make_shared<Elastic>()),
                    Catch::Contains("without tension"));
}
