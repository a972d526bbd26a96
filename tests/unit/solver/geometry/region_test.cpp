#include "solver/geometry/region.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/solver/geometry/scenes.hpp"

using namespace porosph;

TEST_CASE("area and centroid take holes off") {
  const Region region(rectangle(0, 0, 4, 3), {rectangle(1, 1, 2, 2)});
  CHECK(region.area() == Approx(11));
  // first moments of the rectangle less those of the hole
  CHECK(region.centroid().x() == Approx((12 * 2 - 1.5) / 11));
  CHECK(region.centroid().y() == Approx((12 * 1.5 - 1.5) / 11));
  CHECK(Region(embankment()).area() == Approx(44.4 * 6 + 5 * (23 + 5.5) / 2));
}

TEST_CASE("the boundary belongs to the region, holes do not") {
  const Region region(rectangle(0, 0, 4, 3), {rectangle(1, 1, 2, 2)});
  CHECK(region.contains({0.5, 0.5}));
  CHECK(region.contains({4, 3}));
  CHECK(region.contains({4 + 1e-9, 1}));
  CHECK_FALSE(region.contains({4 + 1e-7, 1}));
  CHECK(region.contains({1.5, 1}));
  CHECK_FALSE(region.contains({1.5, 1.5}));
  CHECK_FALSE(region.contains({-1, 1.5}));
  CHECK_FALSE(region.contains({5, 3}));
}

TEST_CASE("distance to the nearest ring, from inside and outside") {
  const Region region(rectangle(0, 0, 4, 3), {rectangle(1, 1, 2, 2)});
  CHECK(region.distance_to_outline({3.5, 1}) == Approx(0.5));
  CHECK(region.distance_to_outline({2.25, 1.5}) == Approx(0.25));
  CHECK(region.distance_to_outline({1.5, 1.4}) == Approx(0.4));
  CHECK(region.distance_to_outline({7, 7}) == Approx(5));
}

TEST_CASE("overlap counts common area only") {
  const Region region(rectangle(0, 0, 4, 3), {rectangle(1, 1, 2, 2)});
  CHECK(region.overlap(Region(rectangle(1, 1, 2, 2))) == Approx(0).margin(1e-12));
  CHECK(region.overlap(Region(rectangle(4, 0, 5, 3))) == Approx(0).margin(1e-12));
  CHECK(region.overlap(Region(rectangle(1, 0, 2, 9))) == Approx(2));
}

TEST_CASE("what is not a polygon is refused") {
  CHECK_THROWS_AS(Region({{0, 0}, {1, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(Region({{0, 0}, {1, 0}, {2, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(Region({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Region(rectangle(0, 0, 1, 1), {rectangle(2, 2, 3, 3)}), std::invalid_argument);
}
