// Paths that turn at walls: every place sees one thing in each direction, and nothing twice.
#include "solver/boundary/wall_paths.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr double range = 1;

Vec2 at_angle(double degrees, double radius = 1) {
  const double a = degrees * std::numbers::pi / 180;
  return radius * Vec2(std::cos(a), std::sin(a));
}

/// A wall whose soil lies on its left, seen from `from`.
Wall wall(const Vec2& from, const Vec2& to) {
  const Vec2 along = (to - from).normalized();
  return {.from = from, .to = to, .normal = Vec2(-along.y(), along.x())};
}

/// Soil of the angle between two long walls that meet at the origin; the first runs to the right.
std::vector<Wall> corner(double degrees) {
  return {wall({0, 0}, {9, 0}), wall(at_angle(degrees, 9), {0, 0})};
}

double angle_of(const Vec2& p) {
  const double degrees = std::atan2(p.y(), p.x()) * 180 / std::numbers::pi;
  return degrees < 0 ? degrees + 360 : degrees;
}

/// Cell centres of a fine lattice that lie in the soil, off its lines of symmetry.
template <class InSoil>
std::vector<Vec2> lattice(double spacing, InSoil&& in_soil) {
  std::vector<Vec2> points;
  for (double y = -3 + 0.37 * spacing; y < 3; y += spacing)
    for (double x = -3 + 0.21 * spacing; x < 3; x += spacing)
      if (in_soil(Vec2(x, y))) points.emplace_back(x, y);
  return points;
}

/// What a place sees of points and their images within the range.
struct Seen {
  std::vector<Vec2> places;
  std::vector<std::int32_t> stems_from;
};
struct Scene {
  std::vector<Vec2> points;
  std::size_t count;
  std::vector<Image> images;
  std::vector<std::int32_t> root;
  WallPaths paths;

  Scene(std::vector<Wall> walls, std::vector<Vec2> soil)
      : points(std::move(soil)), count(points.size()), paths(std::move(walls), range) {
    images = paths.append_seen_images(points);
    root = roots(images, count);
  }
  Seen seen_from(const Vec2& place) const {
    Seen seen;
    const auto near = paths.near(place);
    for (std::size_t b = 0; b < points.size(); ++b) {
      if ((points[b] - place).norm() >= range) continue;
      const bool visible = b < count ? paths.clear(place, points[b], near)
                                     : paths.leads(place, points[b], b - count, images, count, near);
      if (!visible) continue;
      seen.places.push_back(points[b]);
      seen.stems_from.push_back(b < count ? static_cast<std::int32_t>(b) : root[b - count]);
    }
    return seen;
  }
};

/// In how many ways a place of the disc is seen: as soil, or as the image of soil in walls one after the
/// other.
template <class InSoil>
int ways_to(const Vec2& looked_at, const Vec2& place, const std::vector<Wall>& walls, InSoil&& in_soil) {
  const WallPaths paths(walls, range);
  const auto near = paths.near(place);
  std::vector<Vec2> sources;
  const std::function<void(const Vec2&, std::size_t, int)> unfold = [&](const Vec2& at, std::size_t last,
                                                                        int turns) {
    if (in_soil(at) &&
        std::none_of(sources.begin(), sources.end(), [&](const Vec2& s) { return (s - at).norm() < 1e-9; }))
      sources.push_back(at);
    for (std::size_t w = 0; w < walls.size() && turns < 9; ++w)
      if (w != last && walls[w].distance(at) < 0) unfold(walls[w].mirrored(at), w, turns + 1);
  };
  unfold(looked_at, walls.size(), 0);
  int ways = 0;
  for (const Vec2& source : sources) {
    std::vector<Vec2> points = {source, place};
    const std::vector<Image> images = paths.append_seen_images(points);
    ways += (source - looked_at).norm() < 1e-9 && paths.clear(place, source, near);
    for (std::size_t i = 0; i < images.size(); ++i)
      ways += roots(images, 2)[i] == 0 && (points[2 + i] - looked_at).norm() < 1e-9 &&
              paths.leads(place, points[2 + i], i, images, 2, near);
  }
  return ways;
}

}  // namespace

TEST_CASE("a place in a corner of any angle sees each place of its disc once", "[wall_paths]") {
  const double degrees = GENERATE(30., 36., 45., 60., 75., 90., 100., 120., 135., 150., 179., 200., 225.,
                                  240., 270., 300., 330.);
  const std::vector<Wall> walls = corner(degrees);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int trial = 0; trial < 400; ++trial) {
    const Vec2 place = at_angle(degrees * part(random), 0.9 * part(random));
    const Vec2 looked_at = place + at_angle(360 * part(random), range * std::sqrt(part(random)));
    CAPTURE(degrees, place.x(), place.y(), looked_at.x(), looked_at.y());
    CHECK(ways_to(looked_at, place, walls, [&](const Vec2& p) { return angle_of(p) < degrees; }) == 1);
  }
}

TEST_CASE("a place beside a thin plate or a hole sees each place of its disc once", "[wall_paths]") {
  const double size = GENERATE(0.02, 0.3, 0.8), turn = GENERATE(0., 17.);
  const auto turned = [&](double x, double y) { return Vec2(x * at_angle(turn) + y * at_angle(turn + 90)); };
  const auto back = [&](const Vec2& p) { return Vec2(p.dot(at_angle(turn)), p.dot(at_angle(turn + 90))); };
  const double height = GENERATE(0.25, 3.);
  const Vec2 half(size / 2, height / 2);
  const std::array<Vec2, 4> at = {turned(half.x(), half.y()), turned(half.x(), -half.y()),
                                  turned(-half.x(), -half.y()), turned(-half.x(), half.y())};
  const std::vector<Wall> walls = {wall(at[0], at[1]), wall(at[1], at[2]), wall(at[2], at[3]),
                                   wall(at[3], at[0])};
  const auto in_soil = [&](const Vec2& p) { return (back(p).cwiseAbs() - half).maxCoeff() > 0; };
  REQUIRE(walls[0].distance(2 * at[0]) > 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec2 place = turned(half.x() + 0.5 * part(random), half.y() + 0.5 * part(random));
    const Vec2 looked_at = place + Vec2(part(random), part(random));
    if (!in_soil(place) || (looked_at - place).norm() > range) continue;
    CAPTURE(size, height, turn, place.x(), place.y(), looked_at.x(), looked_at.y());
    CHECK(ways_to(looked_at, place, walls, in_soil) == 1);
  }
}

TEST_CASE("what stems from another sees what stems from oneself, at the same distances", "[wall_paths]") {
  const double degrees = GENERATE(40., 75., 110., 220., 300.);
  const Scene scene(corner(degrees), lattice(0.17, [&](const Vec2& p) { return angle_of(p) < degrees; }));
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<double>> distances;
  for (std::size_t a = 0; a < scene.count; ++a) {
    const Seen seen = scene.seen_from(scene.points[a]);
    for (std::size_t k = 0; k < seen.places.size(); ++k)
      distances[{static_cast<std::int32_t>(a), seen.stems_from[k]}].push_back(
          (seen.places[k] - scene.points[a]).norm());
  }
  CHECK(distances.size() > scene.count);
  for (auto& [pair, ways] : distances) {
    std::vector<double> back = distances[{pair.second, pair.first}];
    REQUIRE(back.size() == ways.size());
    std::sort(ways.begin(), ways.end()), std::sort(back.begin(), back.end());
    for (std::size_t k = 0; k < ways.size(); ++k) CHECK(ways[k] == Approx(back[k]));
  }
}

TEST_CASE("soil on both sides of a plate sees its own side, however thin the plate is", "[wall_paths]") {
  const double thickness = GENERATE(0.02, 0.3, 0.8, 1.7), spacing = 0.08;
  // Fixed faces above y = 0, the edge below them is free.
  const std::vector<Wall> faces = {wall({0, 0}, {0, 9}), wall({thickness, 9}, {thickness, 0})};
  const Scene scene(
      faces, lattice(spacing, [&](const Vec2& p) { return p.y() < 0 || p.x() < 0 || p.x() > thickness; }));
  for (const Vec2& place : {Vec2(-0.1, 1.2), Vec2(thickness + 0.1, 1.2), Vec2(-0.3, 1.6)}) {
    const Seen seen = scene.seen_from(place);
    CHECK(seen.places.size() > 400);
    for (const std::int32_t b : seen.stems_from) CHECK((scene.points[b].x() < 0) == (place.x() < 0));
  }
}

TEST_CASE("upright corners with soil between them alone need no paths", "[wall_paths]") {
  const std::vector<Vec2> inside = {{0.3, 0.3}}, behind = {{0.3, 0.3}, {0.3, -0.4}};
  CHECK(WallPaths(corner(90), range).all_in_sight(inside));
  CHECK_FALSE(WallPaths(corner(80), range).all_in_sight(inside));
  CHECK_FALSE(WallPaths(corner(270), range).all_in_sight(inside));
  CHECK_FALSE(WallPaths({wall({0, 0}, {9, 0})}, range).all_in_sight(behind));
}

TEST_CASE("a lattice sees through the corner's point once", "[wall_paths]") {
  // Cell centres lie at the corner's diagonal, so lines to images pass exactly through its point.
  for (const double degrees : {90., 270.}) {
    const double spacing = 0.24;
    std::vector<Vec2> soil;
    for (int j = -9; j < 9; ++j)
      for (int i = -9; i < 9; ++i)
        if (const Vec2 p((i + 0.5) * spacing, (j + 0.5) * spacing); angle_of(p) < degrees) soil.push_back(p);
    const Scene scene(corner(degrees), soil);
    for (const Vec2& place : soil) {
      if (place.norm() > 1.1) continue;
      const std::vector<Vec2> seen = scene.seen_from(place).places;
      CHECK(seen.size() == 57);  // cell centres within the range of one, with itself; none of them twice
      for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) CHECK((seen[i] - seen[k]).norm() > 0.5 * spacing);
    }
  }
}
