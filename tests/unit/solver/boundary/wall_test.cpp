#include "solver/boundary/wall.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

const double range = 1;

std::vector<Wall> walls_of(const std::vector<BoundaryCase>& boundaries, const std::vector<Vec2>& soil) {
  return make_walls(boundaries, soil, range);
}

bool has(const std::vector<Vec2>& points, const Vec2& p) {
  for (const Vec2& q : points)
    if ((p - q).norm() < 1e-12) return true;
  return false;
}

}  // namespace

TEST_CASE("a wall mirrors what is in front of it, up to the range", "[boundary]") {
  const std::vector<Vec2> soil = {{3, 0.25}, {4, 0.75}, {5, 1.25}};
  const auto walls = walls_of({{BoundaryKind::roller, {0, 0}, {10, 0}}}, soil);
  CHECK(walls[0].normal.isApprox(Vec2(0, 1)));
  std::vector<Vec2> points = soil;
  std::vector<Image> images;
  append_images(walls, 0, 1, range, points, images);
  REQUIRE(images.size() == 2);
  CHECK(images[0].parent == 0);
  CHECK(points[3].isApprox(Vec2(3, -0.25)));
  CHECK(images[1].parent == 1);
  CHECK(points[4].isApprox(Vec2(4, -0.75)));
}

TEST_CASE("the normal points to the soil whichever way the wall is drawn", "[boundary]") {
  const std::vector<Vec2> above = {{5, 0.3}}, below = {{5, -0.3}};
  for (const BoundaryCase& b : {BoundaryCase{BoundaryKind::fixed, {0, 0}, {10, 0}},
                                BoundaryCase{BoundaryKind::fixed, {10, 0}, {0, 0}}}) {
    CHECK(walls_of({b}, above)[0].normal.isApprox(Vec2(0, 1)));
    CHECK(walls_of({b}, below)[0].normal.isApprox(Vec2(0, -1)));
  }
  CHECK_THROWS_WITH(walls_of({{BoundaryKind::fixed, {0, 5}, {10, 5}}}, above),
                    Catch::Contains("touches no soil"));
}

TEST_CASE("an inclined wall mirrors across its own line", "[boundary]") {
  const double angle = std::numbers::pi / 6;
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  const std::vector<Vec2> soil = {2 * along + 0.4 * across};
  const auto walls = walls_of({{BoundaryKind::roller, {0, 0}, 4 * along}}, soil);
  CHECK(walls[0].bears_weight);
  CHECK(walls[0].mirrored(soil[0]).isApprox(2 * along - 0.4 * across));
  CHECK((walls[0].reflection() * along).isApprox(along));
  CHECK((walls[0].reflection() * across).isApprox(-across));
  CHECK((walls[0].reflection() * walls[0].reflection()).isIdentity(1e-14));
}

TEST_CASE("walls come in the order in which they mirror: fixed, bearing, others", "[boundary]") {
  const std::vector<Vec2> soil = {{0.3, 0.3}, {3.7, 0.3}, {0.3, 2.7}};
  const auto walls = walls_of({{BoundaryKind::roller, {0, 0}, {0, 3}},
                               {BoundaryKind::roller, {0, 3}, {4, 3}},
                               {BoundaryKind::fixed, {4, 0}, {4, 3}}},
                              soil);
  CHECK(walls[0].kind == BoundaryKind::fixed);
  CHECK(walls[0].bears_weight);
  CHECK(walls[1].bears_weight);
  CHECK_FALSE(walls[2].bears_weight);
  CHECK(walls[2].normal.isApprox(Vec2(1, 0)));
}

TEST_CASE("a corner holds the image of an image", "[boundary]") {
  const auto bottom = GENERATE(BoundaryKind::roller, BoundaryKind::fixed);
  const std::vector<Vec2> soil = {{0.3, 0.2}, {0.4, 2.9}};
  const auto walls = walls_of({{BoundaryKind::roller, {0, 0}, {0, 3}}, {bottom, {0, 0}, {4, 0}}}, soil);
  std::vector<Vec2> points = soil;
  std::vector<Image> images;
  append_images(walls, 0, 2, range, points, images);
  REQUIRE(points.size() == 6);
  CHECK(has(points, {0.3, -0.2}));
  CHECK(has(points, {-0.3, 0.2}));
  CHECK(has(points, {-0.3, -0.2}));
  CHECK(has(points, {-0.4, 2.9}));
  const Image& corner = images.back();  // of the bottom's image, in the side
  CHECK(points[corner.parent].isApprox(Vec2(0.3, -0.2)));
}

TEST_CASE("a wall mirrors nothing beyond an end that no other wall meets", "[boundary]") {
  const std::vector<Vec2> soil = {{1, 0.5}, {2.5, 0.5}};
  const auto alone = walls_of({{BoundaryKind::fixed, {0, 0}, {2, 0}}}, soil);
  CHECK(alone[0].faces(soil[0], range));
  CHECK_FALSE(alone[0].faces(soil[1], range));
}

TEST_CASE("a wall mirrors what lies just at its ends, whichever was written first", "[boundary]") {
  const std::vector<Vec2> soil = {{0, 0.5}, {1, 0.5}, {2, 0.5}};
  const bool turned = GENERATE(false, true);
  const auto wall = walls_of({{BoundaryKind::roller, {turned ? 2. : 0., 0}, {turned ? 0. : 2., 0}}}, soil);
  for (const Vec2& p : soil) CHECK(wall[0].faces(p, range));
}

TEST_CASE("two stretches of one wall mirror each particle once", "[boundary]") {
  std::vector<Vec2> points = {{0, 0.5}, {1, 0.5}, {2, 0.5}, {3, 0.5}, {4, 0.5}};
  const bool first_turned = GENERATE(false, true), second_turned = GENERATE(false, true);
  const auto stretch = [](Point from, Point to, bool turned) {
    return BoundaryCase{.kind = BoundaryKind::fixed, .from = turned ? to : from, .to = turned ? from : to};
  };
  const auto walls =
      walls_of({stretch({0, 0}, {2, 0}, first_turned), stretch({2, 0}, {4, 0}, second_turned)}, points);
  std::vector<Image> images;
  append_images(walls, 0, 2, range, points, images);
  CHECK(images.size() == 5);
}
