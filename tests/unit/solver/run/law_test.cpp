// Laws other than the case's own, inside the loops and from outside them.
#include <catch2/catch.hpp>

#include "solver/output/invariants.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/law_from_outside.hpp"

using namespace porosph;

namespace {

const Elasticity elastic = Elasticity::from_young(15e6, 0.33);  // as in box_of_soil()

Case sliding_column(Motion motion) {
  Case scene = box_of_soil(6, 8, 0.25);
  hold_as_column(scene);
  add_water(scene, 3);
  scene.formulation.motion = motion;
  scene.soils[0].velocity = Point(0.3, 0);
  return scene;
}

/// Two soils, whose particles share tiles.
Case two_layers(Motion motion) {
  Case scene = sliding_column(motion);
  const Polygon whole = scene.soils[0].polygon;
  scene.soils.push_back(scene.soils[0]);
  scene.soils[0].polygon = box_outline(0, 0, 1.5, 1);
  scene.soils[1].polygon = box_outline(0, 1, 1.5, 2);
  scene.soils[1].name = "upper";
  return scene;
}

void compare(const Simulation& one, const Simulation& other) {
  const Particles &a = one.model().particles, &b = other.model().particles;
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK((a.position[i] - b.position[i]).norm() < 1e-12);
    CHECK(b.stress[i].yy == Approx(a.stress[i].yy).epsilon(1e-8).margin(1e-6));
    CHECK(b.stress[i].xy == Approx(a.stress[i].xy).epsilon(1e-8).margin(1e-6));
  }
  REQUIRE(a.history.size() == b.history.size());
  for (std::size_t k = 0; k < a.history.size(); ++k)
    for (std::size_t i = 0; i < a.size(); ++i)
      CHECK(b.history[k].values[i] == Approx(a.history[k].values[i]).epsilon(1e-8).margin(1e-15));
}

double largest_yield(const Simulation& simulation, const DruckerPrager& law) {
  double most = -never;
  for (const Stress& s : simulation.model().particles.stress) most = std::max(most, law.yield(s));
  return most;
}

}  // namespace

TEST_CASE("a law from outside gives what the same law inside the loops gives", "[law]") {
  const Case scene = two_layers(GENERATE(Motion::consistent, Motion::proposed));
  const DruckerPrager weak = DruckerPrager::from_mohr_coulomb(elastic, 2e3, 20, 5);
  Simulation inside(scene), outside(scene);
  inside.set_law("upper", weak);
  outside.set_law("upper", std::make_shared<FromOutside<DruckerPrager>>(weak));
  for (int i = 0; i < 100; ++i) inside.advance(), outside.advance();
  REQUIRE(inside.model().particles.history.size() == DruckerPrager::history.size());
  const std::vector<double>& strain = inside.model().particles.history[0].values;
  CHECK(*std::max_element(strain.begin(), strain.end()) > 1e-4);
  compare(inside, outside);
}

TEST_CASE("an elastic law from outside changes nothing but rounding", "[law]") {
  const Case scene = sliding_column(GENERATE(Motion::consistent, Motion::proposed));
  Simulation plain(scene), own(scene);
  own.set_law("soil", std::make_shared<FromOutside<LinearElastic>>(LinearElastic{elastic}));
  for (int i = 0; i < 60; ++i) plain.advance(), own.advance();
  compare(plain, own);
}

TEST_CASE("no particle of a soil that yields is outside its yield surface", "[law]") {
  const Case scene = sliding_column(GENERATE(Motion::consistent, Motion::proposed));
  const DruckerPrager weak = DruckerPrager::from_mohr_coulomb(elastic, 2e3, 20);
  Simulation plain(scene), own(scene);
  own.set_law("soil", weak);
  for (int i = 0; i < 100; ++i) plain.advance(), own.advance();
  CHECK(largest_yield(plain, weak) > 1e4);
  CHECK(largest_yield(own, weak) < 1e-6);
}

TEST_CASE("a law is given to a soil that there is, and is not stiffer than its time step allows", "[law]") {
  Simulation simulation(box_of_soil(4, 4));
  CHECK_THROWS_WITH(simulation.set_law("clay", LinearElastic{elastic}), "no soil is called 'clay'");
  CHECK_THROWS_WITH(simulation.set_law("soil", LinearElastic::from_young(16e6, 0.33)),
                    Catch::Contains("but the time step is for"));
}

TEST_CASE("a stress along an interface stays near the strength of soil that yields there", "[law]") {
  Case scene = two_layers(Motion::consistent);
  scene.soils[0].youngs_modulus = 150e6, scene.soils[0].poissons_ratio = 0.1;
  scene.soils[1].poissons_ratio = 0.45;
  scene.soils[1].velocity = Point(1.5, 0);
  const double cohesion = 2e3;
  Simulation simulation(scene);
  simulation.set_law("upper",
                     DruckerPrager::from_mohr_coulomb(LinearElastic::from_young(15e6, 0.45), cohesion, 0));
  double most = 0;
  for (int i = 0; i < 600; ++i) {
    simulation.advance();
    REQUIRE_FALSE(simulation.instability());
    const Particles& p = simulation.model().particles;
    for (std::size_t a = 0; a < p.size(); ++a)
      if (p.soil[a] == 1) most = std::max(most, std::abs(p.interface_stress[a]));
  }
  const std::vector<double>& strain = simulation.model().particles.history[0].values;
  CHECK(*std::max_element(strain.begin(), strain.end()) > 0.3);
  CHECK(most < 2.5 * cohesion);  // 3.3 kPa; 184 kPa where it grows on as in elastic soil
}
