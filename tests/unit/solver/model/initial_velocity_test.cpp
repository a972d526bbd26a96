#include "solver/model/initial_velocity.hpp"

#include <catch2/catch.hpp>

using namespace porosph;

namespace {

SoilCase plate() {
  SoilCase soil;
  soil.polygon = {{1, 0}, {11, 0}, {11, 1}, {1, 1}};
  soil.youngs_modulus = 1e6;
  soil.poissons_ratio = 0.3;
  return soil;
}

}  // namespace

TEST_CASE("a soil starts with its velocity, and turns about its middle") {
  SoilCase soil = plate();
  soil.velocity = {3, -1};
  CHECK(initial_velocity(soil, 2000, {2, 0.3}) == Point(3, -1));
  soil.angular_velocity = 2;
  CHECK((initial_velocity(soil, 2000, {6, 0.5}) - Point(3, -1)).norm() < 1e-12);
  CHECK((initial_velocity(soil, 2000, {8, 0.5}) - Point(3, 3)).norm() < 1e-12);
  CHECK((initial_velocity(soil, 2000, {6, 1}) - Point(2, -1)).norm() < 1e-12);
}

TEST_CASE("a plate bends from rest at its left end to the given velocity at its tip") {
  SoilCase soil = plate();
  soil.bending_velocity = 0.4;
  CHECK(initial_velocity(soil, 2000, {1, 0.5}).norm() < 1e-12);
  CHECK((initial_velocity(soil, 2000, {11, 0.5}) - Point(0, 0.4)).norm() < 1e-9);
  const Point below = initial_velocity(soil, 2000, {8, 0.2}), above = initial_velocity(soil, 2000, {8, 0.8});
  CHECK(above.y() == Approx(below.y()));
  CHECK(above.x() == Approx(-below.x()));
  CHECK(above.x() < 0);  // sections turn with the deflection
}
