// Limit equilibrium against published factors of safety and closed solutions.
#include "solver/reference/limit_equilibrium/search.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace porosph;
using namespace porosph::limit_equilibrium;

namespace {

constexpr double water_weight = 9810;

double tangent(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

/// c [Pa], phi [degrees], unit weight [N/m3].
SectionSoil soil(Polygon outline, double cohesion, double friction, double weight = 20e3) {
  return {{std::move(outline)}, weight, weight, SoilStrength{cohesion, tangent(friction)}};
}

CriticalSurfaces surfaces(std::vector<SectionSoil> soils, std::vector<WaterPiece> water = {},
                          double horizontal = 0) {
  const auto found =
      find_critical_surfaces(Section(std::move(soils), std::move(water), water_weight, {}, horizontal));
  REQUIRE(found);
  return *found;
}

/// A slope of `height` that faces right, with ground below its toe to a depth; toe at (0, 0).
Polygon slope(double degrees, double height, double depth) {
  const double run = degrees == 90 ? 0 : height / tangent(degrees), wide = 6 * (height + depth);
  return {{-run - wide, -depth}, {wide, -depth}, {wide, 0}, {0, 0}, {-run, height}, {-run - wide, height}};
}

/// Griffiths and Lane (1999), example 1: 2:1, phi 20 degrees, c = 0.05 gamma H, no ground below the toe.
const Polygon griffiths{{0, 0}, {32, 0}, {12, 10}, {0, 10}};

Polygon mirrored(Polygon outline) {
  for (Point& p : outline) p.x() = -p.x();
  return outline;
}

}  // namespace

// Giam and Donald (1989), Soil slope stability programs review, ACADS U255: factors of the referees. Those of
// Rocscience's Slide2 on circles are compared with Bishop's and Spencer's methods one by one.
TEST_CASE("limit equilibrium finds the referees' factors of the ACADS slopes", "[limit_equilibrium]") {
  SECTION("1(a), one soil: 1.00") {
    const auto found =
        surfaces({soil({{20, 20}, {70, 20}, {70, 35}, {50, 35}, {30, 25}, {20, 25}}, 3e3, 19.6)});
    CHECK(found.bishop.factor == Approx(1.00).margin(0.02));
    CHECK(found.spencer->factor == Approx(1.00).margin(0.02));
    CHECK_FALSE(found.general);
  }
  const double weight = 19.5e3;
  const std::vector<SectionSoil> layers = {
      soil({{50, 29}, {54, 31}, {70, 31}, {70, 35}, {50, 35}, {30, 25}, {40, 27}}, 0, 38, weight),
      soil({{40, 27}, {52, 24}, {70, 24}, {70, 31}, {54, 31}, {50, 29}}, 5.3e3, 23, weight),
      soil({{20, 20}, {70, 20}, {70, 24}, {52, 24}, {40, 27}, {30, 25}, {20, 25}}, 7.2e3, 20, weight)};
  SECTION("1(c), three soils: 1.39") {
    const auto found = surfaces(layers);
    CHECK(found.bishop.factor == Approx(1.39).margin(0.02));
    CHECK(found.spencer->factor == Approx(1.39).margin(0.02));
    CHECK(found.bishop.factor == Approx(1.405).margin(0.004));  // Slide2
    CHECK(found.spencer->factor == Approx(1.375).margin(0.004));
    CHECK(found.general->factor <= found.spencer->factor);
  }
  SECTION("1(d), the same in an earthquake: 1.00") {
    const auto found = surfaces(layers, {}, -0.15);
    CHECK(found.bishop.factor == Approx(1.00).margin(0.02));
    CHECK(found.spencer->factor == Approx(1.00).margin(0.02));
    CHECK(found.bishop.factor == Approx(1.016).margin(0.004));  // Slide2
    CHECK(found.spencer->factor == Approx(0.991).margin(0.004));
    CHECK(surfaces(layers, {}, 0.15).bishop.factor > 1.5);
  }
  SECTION("3(a), a weak seam, which no circle follows: 1.24 to 1.27") {
    const double unit = 18.84e3;
    const auto found = surfaces(
        {soil({{20, 20}, {84, 20}, {84, 26.5}, {20, 26.5}}, 28.5e3, 20, unit),
         soil({{20, 26.5}, {84, 26.5}, {84, 27}, {20, 27}}, 0, 10, unit),
         soil({{20, 27}, {84, 27}, {84, 40}, {67.5, 40}, {43, 27.75}, {20, 27.75}}, 28.5e3, 20, unit)});
    CHECK(found.general->factor == Approx(1.24).margin(0.02));
    CHECK(found.bishop.factor > 1.5);
  }
}

TEST_CASE("limit equilibrium finds the factors of Griffiths and Lane", "[limit_equilibrium]") {
  SECTION("example 1: 1.38 by Bishop and Morgenstern") {
    const auto found = surfaces({soil(griffiths, 10e3, 20)});
    CHECK(found.bishop.factor == Approx(1.38).margin(0.01));
    CHECK(found.spencer->factor == Approx(1.38).margin(0.01));
  }
  SECTION("under water: 1.84 by finite elements and by Morgenstern's charts") {
    const auto found = surfaces({soil(griffiths, 10e3, 20)}, {{{0, 15}, {32, 15}}});
    CHECK(found.bishop.factor == Approx(1.84).margin(0.03));
    CHECK(found.spencer->factor == Approx(1.84).margin(0.03));
  }
  SECTION("undrained, as much ground below the toe as above it: 1.47 by Taylor") {
    const auto found = surfaces({soil({{0, 0}, {60, 0}, {60, 10}, {40, 10}, {20, 20}, {0, 20}}, 50e3, 0)});
    CHECK(found.bishop.factor == Approx(1.47).margin(0.01));
  }
}

// Taylor (1937): c / (F gamma H) of a slope in one soil; c and phi both divided by F = 1.
TEST_CASE("limit equilibrium finds Taylor's stability numbers", "[limit_equilibrium]") {
  struct Entry {
    double slope, friction, number;
  };
  const Entry entry =
      GENERATE(Entry{90, 0, 0.261}, Entry{90, 10, 0.218}, Entry{90, 25, 0.166}, Entry{75, 5, 0.195},
               Entry{75, 20, 0.134}, Entry{60, 0, 0.191}, Entry{60, 15, 0.116}, Entry{60, 25, 0.079},
               Entry{45, 5, 0.136}, Entry{45, 15, 0.083}, Entry{30, 5, 0.110}, Entry{30, 15, 0.046});
  CAPTURE(entry.slope, entry.friction);
  const double height = 7, weight = 18e3;
  const auto found = surfaces(
      {soil(slope(entry.slope, height, height), entry.number * weight * height, entry.friction, weight)});
  // On steep slopes with friction Bishop's soil hangs on its crest, which makes it weaker by friction.
  CHECK(found.bishop.factor == Approx(1).margin(entry.slope > 70 && entry.friction > 0 ? 0.08 : 0.025));
  // Spencer's method has no solution where soil would have to hang there.
  if (found.spencer) CHECK(found.spencer->factor == Approx(1).margin(0.03));
}

TEST_CASE("without friction Bishop and Spencer agree on circles, under water as well",
          "[limit_equilibrium]") {
  const double level = GENERATE(-never, -1.0, 4.0, 12.0);
  CAPTURE(level);
  std::vector<WaterPiece> water;
  if (level > -never) water.push_back({{-500, level}, {500, level}});
  const auto found = surfaces({soil(slope(35, 10, 8), 60e3, 0)}, water);
  CHECK(found.spencer->factor == Approx(found.bishop.factor).epsilon(1e-4));
}

TEST_CASE("an upright cut bears 3.83 c / gamma of soil, under water of buoyant soil", "[limit_equilibrium]") {
  const double height = 5, cohesion = 25e3, weight = 20e3;
  const double below = GENERATE(0.0, 5.0);
  CAPTURE(below);
  const auto dry = surfaces({soil(slope(90, height, below), cohesion, 0, weight)});
  CHECK(dry.bishop.factor == Approx(3.83 * cohesion / (weight * height)).epsilon(0.002));
  const auto wet = surfaces({soil(slope(90, height, below), cohesion, 0, weight)}, {{{-500, 8}, {500, 8}}});
  CHECK(wet.bishop.factor == Approx(3.83 * cohesion / ((weight - water_weight) * height)).epsilon(0.002));
  CHECK(wet.spencer->factor == Approx(wet.bishop.factor).epsilon(1e-3));
}

TEST_CASE("an upright cut at the end of a section is as one in its midst", "[limit_equilibrium]") {
  const bool right = GENERATE(true, false);
  CAPTURE(right);
  Polygon box{{0, 0}, {20, 0}, {20, 10}, {0, 10}};
  if (!right) box = mirrored(box);
  const SectionSoil clay = soil(box, 66666.67, 0);
  const Section open({clay}, {}, water_weight, {}, 0, {!right, right});
  CHECK(find_critical_surfaces(open)->bishop.factor == Approx(3.83 / 3).epsilon(0.002));
  CHECK_FALSE(find_critical_surfaces(Section({clay}, {}, water_weight)));
}

// (c + (gamma z cos^2 b - u) tan phi) / (gamma z sin b cos b), z the depth of rock under a long slope. What
// pushes it down the slope adds k cos^2 b to what drives it and takes k sin b cos b from what presses it on.
TEST_CASE("limit equilibrium finds the infinite slope's factor over rock", "[limit_equilibrium]") {
  const double degrees = GENERATE(15.0, 25.0), cohesion = GENERATE(0.0, 4e3), friction = 30, weight = 19e3;
  const double seepage = GENERATE(0.0, 1.0);  // whether water flows parallel to the slope, up to the ground
  const double pushed = GENERATE(0.0, 0.1);   // to the left, over g
  CAPTURE(degrees, cohesion, seepage, pushed);
  const double depth = 2, length = 400, fall = length * tangent(degrees);
  const SectionSoil cover =
      soil({{0, -depth}, {0, 0}, {length, fall}, {length, fall - depth}}, cohesion, friction, weight);
  SectionSoil rock =
      soil({{0, -depth - 10}, {0, -depth}, {length, fall - depth}, {length, -depth - 10}}, 0, 0);
  rock.strength.reset();
  std::vector<WaterPiece> water;
  if (seepage > 0) water.push_back({{0, 0}, {length, fall}});
  const auto found = surfaces({cover, rock}, water, -pushed);
  const double angle = degrees * std::numbers::pi / 180, sine = std::sin(angle), cosine = std::cos(angle);
  // Pore pressure of the section is hydrostatic below the line: gamma_w z, a little more than that of flow.
  const double pressure = seepage * water_weight * depth;
  const double pressing = weight * depth * cosine * (cosine - pushed * sine),
               driving = weight * depth * cosine * (sine + pushed * cosine);
  const double expected = (cohesion + (pressing - pressure) * tangent(friction)) / driving;
  if (seepage > 0 && cohesion == 0) return;  // without cohesion the skin slides first, whatever its depth
  REQUIRE(found.general);
  CHECK(found.general->factor == Approx(expected).epsilon(0.03));
}

TEST_CASE("limit equilibrium is the same seen from behind, and finds the worse of two slopes",
          "[limit_equilibrium]") {
  const auto one = surfaces({soil(griffiths, 10e3, 20)});
  const auto other = surfaces({soil(mirrored(griffiths), 10e3, 20)});
  CHECK(one.bishop.factor == Approx(other.bishop.factor).epsilon(1e-12));
  CHECK(one.bishop.points.front().x() == Approx(-other.bishop.points.back().x()));
  const Polygon dam{{0, 0}, {55, 0}, {30, 10}, {20, 10}};  // 2:1 on the left, 2.5:1 on the right
  const auto worse = surfaces({soil(dam, 10e3, 20)});
  CHECK(worse.bishop.points.front().x() < 10);
  CHECK(worse.bishop.factor == Approx(1.38).margin(0.01));
}

TEST_CASE("undrained strength that grows with depth", "[limit_equilibrium]") {
  // Gibson and Morgenstern (1962): strength in proportion to depth below the crest, F the same for all
  // circles and all heights. 45 degrees: 2 c / gamma' z = F / ... is checked as independence of height.
  const auto factor = [](double height) {
    SectionSoil clay = soil(slope(45, height, 2 * height), 0, 0);
    clay.strength = SoilStrength{0, 0, 3e3, height};
    return surfaces({clay}).bishop.factor;
  };
  CHECK(factor(20) == Approx(factor(5)).epsilon(1e-6));
}

TEST_CASE("nothing slides on level ground, through rock, or without soil", "[limit_equilibrium]") {
  const Polygon level{{0, 0}, {10, 0}, {10, 5}, {0, 5}};
  CHECK_FALSE(find_critical_surfaces(Section({soil(level, 1e3, 10)}, {}, water_weight)));
  SectionSoil rock = soil(griffiths, 0, 0);
  rock.strength.reset();
  CHECK_FALSE(find_critical_surfaces(Section({rock}, {}, water_weight)));
  CHECK_FALSE(find_critical_surfaces(Section({}, {}, water_weight)));
  CHECK_THROWS_AS(Section({soil(level, 1e3, 10, 0)}, {}, water_weight), std::invalid_argument);
}

TEST_CASE("a load on the crest drives, one at the toe holds, and soil above ground is the same as its weight",
          "[limit_equilibrium]") {
  const double cohesion = 30e3;
  const SectionSoil clay = soil(slope(45, 6, 6), cohesion, 0);
  const auto factor = [&](std::vector<GroundLoad> loads) {
    return find_critical_surfaces(Section({clay}, {}, water_weight, std::move(loads)))->bishop.factor;
  };
  const Point down(0, -40e3);
  const double bare = factor({});
  CHECK(factor({{{-26, 6}, {-6, 6}, down, down}}) < 0.9 * bare);
  CHECK(factor({{{0, 0}, {20, 0}, down, down}}) > bare);
  // Water that stands over all the ground, as a load and as buoyancy: the same circle without friction.
  const double level = 10;
  const auto pressed = [&](const Point& a, const Point& b) {
    const Point normal = Point(b.y() - a.y(), a.x() - b.x()).normalized();
    return GroundLoad{a, b, normal * water_weight * (level - a.y()), normal * water_weight * (level - b.y())};
  };
  const double drowned =
      find_critical_surfaces(Section({clay}, {{{-500, level}, {500, level}}}, water_weight))->bishop.factor;
  CHECK(factor({pressed({-78, 6}, {-6, 6}), pressed({-6, 6}, {0, 0}), pressed({0, 0}, {72, 0})}) ==
        Approx(drowned).epsilon(1e-3));
}
