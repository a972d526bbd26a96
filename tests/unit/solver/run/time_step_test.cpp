// The time step: from the Courant number, from the case, and of a run that is resumed to a later end.
#include <catch2/catch.hpp>

#include "solver/run/highest_frequency.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

Case column() {
  Case scene = box_of_soil(4, 6);
  hold_as_column(scene);
  scene.formulation.bulk_viscosity = 0.06, scene.formulation.zero_energy_control = 0.2;
  return scene;
}

double largest_step(const Simulation& s) {
  return s.scene().time.courant * s.model().smoothing_length / s.model().wave_speed;
}

}  // namespace

TEST_CASE("the fastest vibration of disordered particles is resolved as that of a lattice", "[time]") {
  Case scene = box_of_soil(10, 10);
  scene.time = {.end = 50, .courant = GENERATE(0.2, 1.0)};
  const Simulation lattice(scene);
  CHECK(lattice.courant() == scene.time.courant);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = GENERATE(0.25, 0.45);
  const Simulation disordered(scene);
  CHECK(disordered.courant() < scene.time.courant);
  CHECK(disordered.time_step() < lattice.time_step());
  const auto angle = [](const Simulation& s) {
    return s.time_step() * highest_frequency(s.scene().formulation, s.model());
  };
  // A lattice without free corners has 1.7, for which Courant numbers are meant; one with them is faster.
  CHECK(angle(disordered) == Approx(1.7 * scene.time.courant).epsilon(1e-3));
  CHECK(angle(lattice) == Approx(1.85 * scene.time.courant).epsilon(1e-3));
}

TEST_CASE("disorder that makes nothing stiffer leaves the Courant number", "[time]") {
  Case scene = box_of_soil(10, 10);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0;
  CHECK(Simulation(scene).courant() <= scene.time.courant);
  CHECK(Simulation(scene).courant() > 0.9 * scene.time.courant);
}

TEST_CASE("a case's own time step is used, and must be one that the Courant number allows", "[time]") {
  Case scene = column();
  const double largest = largest_step(Simulation(scene));
  scene.time.step = 0.3 * largest;
  const Simulation s(scene);
  CHECK(s.time_step() == scene.time.step);
  const double end = static_cast<double>(s.last_step()) * s.time_step();
  CHECK(end >= scene.time.end * (1 - 1e-12));
  CHECK(end < scene.time.end + s.time_step());
  scene.time.step = largest;
  CHECK(Simulation(scene).time_step() == largest);
  scene.time.step = 1.001 * largest;
  CHECK_THROWS_WITH(Simulation(scene), Contains("time.step") && Contains("must be <="));
}

TEST_CASE("whole steps of the step that a case gives reach the end that they make", "[time]") {
  Case scene = column();
  for (const double end : {0.1, 0.3, 0.7, 1.1}) {
    scene.time = {.end = end};
    const Simulation rounded(scene);
    scene.time.step = rounded.time_step();
    const Simulation given(scene);
    CAPTURE(end);
    CHECK(given.last_step() == rounded.last_step());
    CHECK(given.time_step() == rounded.time_step());
  }
}
