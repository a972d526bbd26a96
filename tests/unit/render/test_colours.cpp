#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "render/colour_bar.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

/// CIE 1976 L* of an sRGB colour.
double lightness(const Colour& colour) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(colour[0] / 255.) + 0.7152 * linear(colour[1] / 255.) +
                   0.0722 * linear(colour[2] / 255.);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

double difference(const Colour& a, const Colour& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEST_CASE("sequential colour maps grow lighter, evenly") {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis}) {
    const auto table = colour_table(map, 33);
    const double step = (lightness(table.back()) - lightness(table.front())) / 32;
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      const double rise = lightness(table[i + 1]) - lightness(table[i]);
      CHECK(rise > 0.4 * step);
      CHECK(rise < 1.6 * step);
    }
  }
  CHECK(colour_table(ColourMap::viridis).front() == Colour{0x44, 0x01, 0x54});
  CHECK(colour_table(ColourMap::viridis).back() == Colour{0xfd, 0xe7, 0x25});
}

TEST_CASE("the diverging colour map is lightest and neutral in its middle, symmetric in lightness") {
  const auto table = colour_table(ColourMap::cool_warm, 33);
  for (int i = 0; i < 16; ++i) {
    CHECK(lightness(table[i]) < lightness(table[i + 1]));
    CHECK(lightness(table[32 - i]) < lightness(table[31 - i]));
    CHECK(lightness(table[i]) == Approx(lightness(table[32 - i])).margin(3));
  }
  CHECK(std::abs(table[16][0] - table[16][2]) < 4);
  CHECK(table.front()[2] > table.front()[0]);
  CHECK(table.back()[0] > table.back()[2]);
}

TEST_CASE("the colour of invalid values is not in the map") {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis, ColourMap::cool_warm})
    for (const Colour& colour : colour_table(map)) CHECK(difference(colour, invalid_colour(map)) > 40);
}

TEST_CASE("ranges are rounded outwards") {
  CHECK(rounded_range({-101.9, 0}) == ValueRange{-110, 0});
  CHECK(rounded_range({0, 100}) == ValueRange{0, 100});
  const ValueRange narrow = rounded_range({98.001, 98.119});
  CHECK(narrow.low == Approx(98));
  CHECK(narrow.high == Approx(98.12));
  CHECK(rounded_range({1e-9, 2e-8}).high == Approx(2e-8));
}

TEST_CASE("values that are all equal, or none, still have a range") {
  CHECK(rounded_range({0, 0}) == ValueRange{-1, 1});
  const ValueRange five = rounded_range({5, 5});
  CHECK(five.low == Approx(4.5));
  CHECK(five.high == Approx(5.5));
  const ValueRange rounding = rounded_range({-98.1, -98.1 + 1e-13});
  CHECK(rounding.low < -98.1);
  CHECK(rounding.high > -98.1);
  CHECK(rounding.high - rounding.low > 1);
  CHECK(rounded_range(finite_extent(std::vector<double>{NAN, NAN})) == ValueRange{0, 1});
}

TEST_CASE("centred ranges hold zero in the middle") {
  CHECK(centred_range({-3.2, 9.4}) == ValueRange{-10, 10});
  CHECK(centred_range({0, 0}) == ValueRange{-1, 1});
  CHECK(centred_range({2, 3}).low == Approx(-3));
}

TEST_CASE("the extent ignores values that are not finite") {
  const std::vector<double> values = {NAN, 3, -std::numeric_limits<double>::infinity(), -2};
  CHECK(finite_extent(values) == ValueRange{-2, 3});
}

TEST_CASE("a scale knows which values its range does not hold") {
  const std::vector<double> values = {-5, 2, NAN};
  const FixedScale given = fix_scale({.label = "p [kPa]", .range = ValueRange{-4, 4}}, values);
  CHECK(given.values_below);
  CHECK_FALSE(given.values_above);
  CHECK(given.values_invalid);
  const FixedScale found = fix_scale({.label = "p [kPa]"}, values);
  CHECK_FALSE(found.values_below);
  CHECK(found.range == ValueRange{-5, 2});
  CHECK(fix_scale({.label = "", .map = ColourMap::cool_warm}, values).range == ValueRange{-5, 5});
}

TEST_CASE("a colour range that is empty or not finite is an error that names it") {
  const std::vector<double> values = {1};
  CHECK_THROWS_WITH((fix_scale({.label = "p [kPa]", .range = ValueRange{2, 2}}, values)),
                    Catch::Contains("2 to 2") && Catch::Contains("p [kPa]"));
  CHECK_THROWS_AS((fix_scale({.label = "", .range = ValueRange{0, NAN}}, values)), std::runtime_error);
}

TEST_CASE("values get the colours of their place in the range") {
  const FixedScale scale{.label = "", .map = ColourMap::viridis, .range = {0, 1}};
  const auto table = colour_table(ColourMap::viridis);
  const auto colours = colours_of(std::vector<double>{0, 1, -7, 7, 0.5, NAN}, scale);
  CHECK(colours[0] == table.front());
  CHECK(colours[1] == table.back());
  CHECK(colours[2] == table.front());
  CHECK(colours[3] == table.back());
  CHECK(colours[4] == table[128]);
  CHECK(colours[5] == invalid_colour(ColourMap::viridis));
}

TEST_CASE("logarithmic colours give every decade its share, and zero the low end") {
  const std::vector<double> values = {0, 0.01, 0.1, 1, 10, 36, -1};
  const FixedScale scale =
      fix_scale({.label = "", .range = ValueRange{0.01, 10}, .logarithmic = true}, values);
  CHECK(scale.logarithmic);
  CHECK(scale.values_below);
  CHECK(scale.values_above);
  const auto table = colour_table(ColourMap::viridis);
  const auto colours = colours_of(values, scale);
  CHECK(colours[0] == table.front());
  CHECK(colours[1] == table.front());
  CHECK(colours[2] == table[85]);
  CHECK(colours[3] == table[170]);
  CHECK(colours[4] == table.back());
  CHECK(colours[5] == table.back());
  CHECK(colours[6] == table.front());
  CHECK(scale.levels.size() == 8);  // 0.02, 0.05, 0.1, ... 5
  // A range that holds zero has no logarithm: it stays linear.
  CHECK_FALSE(fix_scale({.label = "", .range = ValueRange{0, 10}, .logarithmic = true}, values).logarithmic);
}

TEST_CASE("a range does not follow single spots") {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.1 * i);
  CHECK(robust_extent(values) == finite_extent(values));
  values[500] = -1e4;
  values[501] = NAN;
  const ValueRange core = robust_extent(values);
  CHECK(core.low == Approx(0.4).margin(0.2));
  CHECK(core.high == Approx(99.5).margin(0.2));
  CHECK(robust_extent(std::vector<double>{1, 2, 1e9}).high == 1e9);  // too few to tell
}

TEST_CASE("one run far beyond the others does not spoil their range") {
  const std::vector<ValueRange> runs = {{-100, 0}, {-110, 5}, {-200, 60}, {-105, 0}};
  CHECK(usual_extent(runs) == ValueRange{-110, 5});
  CHECK(usual_extent(std::span(runs).last(2)) == ValueRange{-200, 60});  // of two, which is the odd one?
  CHECK(usual_extent(std::vector<ValueRange>{{0, 0}, {0, 0}, {0, 3}}) == ValueRange{0, 3});
}

TEST_CASE("tension has colours that compression does not have") {
  const FixedScale scale{.label = "", .map = ColourMap::viridis, .range = {-200, 50}};
  const std::vector<double> values = {-200, -100, -1, 5, 49};
  const auto colours = colours_of(values, scale);
  for (std::size_t i = 0; i < 3; ++i) CHECK(colours[i][0] <= colours[i][1] + 70);  // violet, green, yellow
  CHECK(colours[0] == colour_table(ColourMap::viridis).front());
  CHECK(colours[4][0] > 2 * colours[4][1] + 60);  // dark red
  const auto plain = colours_of(values, {.label = "", .map = ColourMap::viridis, .range = {-200, 0}});
  CHECK(plain[4] == colour_table(ColourMap::viridis).back());
}
