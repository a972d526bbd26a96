// What particles see as they move, against searches from scratch.
#include "solver/sph/consistent/surroundings.hpp"

#include <catch2/catch.hpp>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// In the corner of a fixed base that ends under the soil and an upright roller.
Model soil_in_a_corner() {
  Case scene = box_of_soil(15, 10, 0.2);
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {2.1, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 2.5});
  return build_model(scene);
}

void check_same(const SeenNeighbours& seen, const SeenNeighbours& expected) {
  REQUIRE(seen.points.size() == expected.points.size());
  for (std::size_t k = 0; k < seen.points.size(); ++k) REQUIRE(seen.points[k] == expected.points[k]);
  REQUIRE(seen.list.begin == expected.list.begin);
  REQUIRE(seen.list.index == expected.list.index);
}

}  // namespace

TEST_CASE("what moving particles see is what a search from scratch finds", "[neighbours]") {
  Model model = soil_in_a_corner();
  Surroundings surroundings(model);
  Noise noise(3);
  const double step = 0.1 * model.spacing;
  for (int k = 0; k < 40; ++k) {
    check_same(surroundings.find(model), Surroundings(model).find(model));
    // Pressed into the corner, and along the base to its end and beyond.
    for (Vec2& x : model.particles.position) {
      x += step * Vec2(noise() + (x.x() > 1.5 ? 0.3 : -0.3), noise() - 0.3);
      x = x.cwiseMax(0.02 * model.spacing);
    }
  }
  CHECK(surroundings.searches() > 2);
  CHECK(surroundings.searches() < 30);
}

TEST_CASE("strangers are found once they come near, and neighbours are not strangers", "[neighbours]") {
  Model model = soil_in_a_corner();
  Surroundings surroundings(model);
  std::vector<double> volumes;
  const SeenNeighbours seen = surroundings.find(model);
  volumes.assign(seen.points.size(), model.spacing * model.spacing);
  const CubicSpline<2> kernel(model.smoothing_length);
  const PairStencils stencils = make_pair_stencils(seen.points, seen.list, volumes, kernel);
  CHECK_FALSE(surroundings.strangers_are_near(model, stencils, seen.points));

  // The last particle of all is taken to the other side of the first one, outside of the soil.
  std::vector<Vec2>& position = model.particles.position;
  const auto place = [&](double distance) { return Vec2(position[0] - distance * Vec2(1, 1).normalized()); };
  position.back() = place(kernel.support());
  CHECK_FALSE(surroundings.strangers_are_near(model, stencils, seen.points));
  position.back() = place(0.7 * kernel.support());
  CHECK(surroundings.strangers_are_near(model, stencils, seen.points));
}
