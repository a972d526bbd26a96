// Paths that turn at walls: every place sees one thing in each direction, and nothing twice.
#include "solver/boundary/wall_paths.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

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
  for (double y = -2.5 + 0.37 * spacing; y < 2.5; y += spacing)
    for (double x = -2.5 + 0.21 * spacing; x < 2.5; x += spacing)
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

}  // namespace

TEST_CASE("a place in a corner of any angle sees its whole disc once", "[wall_paths]") {
  const double degrees =
      GENERATE(30., 45., 60., 75., 90., 100., 135., 150., 179., 200., 240., 270., 300., 330.);
  const double spacing = 0.02, full = std::numbers::pi * range * range;
  const Scene scene(corner(degrees), lattice(spacing, [&](const Vec2& p) { return angle_of(p) < degrees; }));
  for (const double part : {0.1, 0.35, 0.5, 0.8})
    for (const double radius : {0.13, 0.4, 0.75}) {
      const Vec2 place = at_angle(part * degrees, radius);
      const Seen seen = scene.seen_from(place);
      CAPTURE(degrees, part, radius);
      CHECK(static_cast<double>(seen.places.size()) * spacing * spacing == Approx(full).epsilon(0.01));
      // Not only as much in all, but in every direction: the sixteenth parts of the disc.
      std::map<int, int> sectors;
      for (const Vec2& p : seen.places) ++sectors[static_cast<int>(angle_of(p - place) / 22.5)];
      for (int k = 0; k < 16; ++k) CHECK(sectors[k] * spacing * spacing == Approx(full / 16).epsilon(0.06));
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
  const double thickness = GENERATE(0.02, 0.3, 0.8, 1.7), spacing = 0.02;
  // Fixed faces above y = 0, the edge below them is free.
  const std::vector<Wall> faces = {wall({0, 0}, {0, 9}), wall({thickness, 9}, {thickness, 0})};
  const Scene scene(
      faces, lattice(spacing, [&](const Vec2& p) { return p.y() < 0 || p.x() < 0 || p.x() > thickness; }));
  const double full = std::numbers::pi * range * range;
  const auto area = [&](const Vec2& place) {
    const Seen seen = scene.seen_from(place);
    for (const std::int32_t b : seen.stems_from)
      if (place.y() > range) CHECK((scene.points[b].x() < 0) == (place.x() < 0));
    return static_cast<double>(seen.places.size()) * spacing * spacing;
  };
  CHECK(area({-0.1, 1.2}) == Approx(full).epsilon(0.01));
  CHECK(area({thickness + 0.1, 1.2}) == Approx(full).epsilon(0.01));
  CHECK(area({-0.1, 0.3}) == Approx(full).epsilon(0.01));
}

TEST_CASE("a wall may stand behind another", "[wall_paths]") {
  // A hole of half the range: images of one face are not seen through another.
  const double half = 0.25, spacing = 0.02;
  const std::vector<Wall> hole = {wall({half, -half}, {-half, -half}), wall({-half, -half}, {-half, half}),
                                  wall({-half, half}, {half, half}), wall({half, half}, {half, -half})};
  const Scene scene(hole, lattice(spacing, [&](const Vec2& p) { return p.cwiseAbs().maxCoeff() > half; }));
  const double full = std::numbers::pi * range * range;
  for (const Vec2& place :
       {Vec2(0, 0.3), Vec2(0.2, 0.35), Vec2(0.3, 0.3), Vec2(-0.5, 0.1), Vec2(0.6, -0.7)}) {
    CAPTURE(place.x(), place.y());
    CHECK(static_cast<double>(scene.seen_from(place).places.size()) * spacing * spacing ==
          Approx(full).epsilon(0.01));
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
      CHECK(seen.size() == 56);  // cell centres within the range of one, none of them twice
      for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) CHECK((seen[i] - seen[k]).norm() > 0.5 * spacing);
    }
  }
}
