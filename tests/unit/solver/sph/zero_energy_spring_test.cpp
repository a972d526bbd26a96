// The spring against displacements that alternate from particle to particle.
#include "solver/sph/consistent/zero_energy_spring.hpp"

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

Case soft_column() {
  Case scene = box_of_soil(6, 8);
  scene.soils[0].youngs_modulus = 4e5;  // strains of some per cent
  hold_as_column(scene);
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.closed_gradients = false;  // which a column that strains unevenly may need
  scene.loading.damping = 0.05;
  scene.time.end = 10;
  return scene;
}

/// Largest difference of positions after some renewals of the reference [m].
double apart(const Case& a, const Case& b) {
  Simulation one(a), other(b);
  for (int i = 0; i < 300; ++i) one.advance(), other.advance();
  REQUIRE(one.dynamics().counts.refreshes > 1);
  double most = 0;
  for (std::size_t i = 0; i < one.model().particles.size(); ++i)
    most = std::max(most, (one.model().particles.position[i] - other.model().particles.position[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("one soil in whole cells has no spring, however much it deforms", "[spring]") {
  Case none = soft_column();
  none.formulation.zero_energy_stiffness = 0;
  CHECK(apart(soft_column(), none) == 0);
}

TEST_CASE("cells that the outline cuts are held by a spring", "[spring]") {
  Case cut = soft_column();
  cut.soils[0].polygon = {{0, 0}, {3, 0}, {3, 3.7}, {0, 4.1}};
  cut.particles.arrangement = Arrangement::fitted;
  Case none = cut, usual = cut;
  none.formulation.zero_energy_stiffness = 0, usual.formulation.zero_energy_stiffness = 0.1;
  CHECK(apart(cut, usual) == 0);
  CHECK(apart(cut, none) > 1e-6);
}
