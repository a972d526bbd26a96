#include <algorithm>
#include <catch2/catch.hpp>

#include "solver/sph/neighbours/cell_grid.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Points in a square of side 2, some on top of each other, and a few very far away.
std::vector<Vec2> scattered(std::size_t count) {
  Noise noise(3);
  std::vector<Vec2> points(count);
  for (Vec2& p : points) p = noise.vector();
  points[5] = points[4];
  points[10] = {1e7, -3e6};
  points[11] = {1e7, -3e6 + 0.1};
  points[12] = {-4e9, 0};
  return points;
}

std::vector<std::int32_t> near(const Vec2& centre, const std::vector<Vec2>& points, double radius) {
  std::vector<std::int32_t> found;
  for (std::size_t b = 0; b < points.size(); ++b)
    if ((points[b] - centre).norm() < radius) found.push_back(static_cast<std::int32_t>(b));
  return found;
}

std::vector<std::int32_t> listed(const NeighbourList& list, std::size_t a) {
  const auto of = list.of(a);
  return {of.begin(), of.end()};
}

}  // namespace

TEST_CASE("neighbours among all points are those that brute force finds", "[neighbours]") {
  const std::vector<Vec2> points = scattered(400);
  const double radius = GENERATE(0.07, 0.3, 5.0);
  const NeighbourList list = find_neighbours(points, 300, radius);
  REQUIRE(list.begin.size() == 301);
  for (std::size_t a = 0; a < 300; ++a) {
    std::vector<std::int32_t> expected = near(points[a], points, radius);
    std::erase(expected, static_cast<std::int32_t>(a));
    CHECK(listed(list, a) == expected);
  }
}

TEST_CASE("neighbours of other centres are those that brute force finds", "[neighbours]") {
  const std::vector<Vec2> points = scattered(200);
  const std::vector<Vec2> centres = {{0.1, 0.2}, {1.2, 1.2}, {-500, 3}, {1e7, -3e6}, {8e9, 8e9}};
  const NeighbourList list = find_neighbours(centres, points, 0.4);
  for (std::size_t a = 0; a < centres.size(); ++a) CHECK(listed(list, a) == near(centres[a], points, 0.4));
  CHECK(list.of(3).size() == 2);
  CHECK(find_neighbours(centres, std::vector<Vec2>{}, 0.4).index.empty());
}

TEST_CASE("a grid of cells in space leaves no neighbour out and visits none twice", "[neighbours]") {
  Noise noise(4);
  std::vector<Eigen::Vector3d> points(500);
  for (auto& p : points) p = {noise(), noise(), noise()};
  points[7] = {900, -1e5, 40};
  const double radius = GENERATE(0.2, 0.6);
  const CellGrid<3> grid(points, radius);
  for (const auto& centre : points) {
    std::vector<int> visits(points.size(), 0);
    grid.around(centre, [&](std::span<const std::int32_t> numbers, const Vec3*) {
      for (const std::int32_t b : numbers) ++visits[b];
    });
    for (std::size_t b = 0; b < points.size(); ++b) {
      REQUIRE(visits[b] <= 1);
      if ((points[b] - centre).norm() < radius) REQUIRE(visits[b] == 1);
    }
  }
}
