#include <catch2/catch.hpp>
#include <cmath>

#include "render/axes.hpp"
#include "render/nice_ticks.hpp"

using namespace porosph;
using namespace porosph::render;

TEST_CASE("a nice step is 1, 2 or 5 times a power of ten, not below the wanted one") {
  CHECK(nice_step(1) == Approx(1));
  CHECK(nice_step(1.1) == Approx(2));
  CHECK(nice_step(0.021) == Approx(0.05));
  CHECK(nice_step(6e7) == Approx(1e8));
  CHECK(nice_step(2e-9) == Approx(2e-9));
}

TEST_CASE("linear ticks are evenly spaced multiples within the bounds") {
  for (const auto& [low, high] :
       {std::pair{0., 0.4}, {-110., 0.}, {3.7e-6, 9.1e-6}, {98.0, 98.13}, {-7., 1e6}}) {
    for (int most = 2; most <= 12; ++most) {
      const auto ticks = linear_ticks(low, high, most);
      INFO(low << " to " << high << ", at most " << most);
      REQUIRE(!ticks.empty());
      CHECK(static_cast<int>(ticks.size()) <= most);
      const double span = high - low;
      CHECK(ticks.front() >= low - 1e-9 * span);
      CHECK(ticks.back() <= high + 1e-9 * span);
      for (std::size_t i = 0; i + 1 < ticks.size(); ++i)
        CHECK(ticks[i + 1] - ticks[i] == Approx(nice_step(ticks[i + 1] - ticks[i])));
    }
  }
}

TEST_CASE("bounds that are ticks but for rounding carry ticks") {
  const auto ticks = linear_ticks(0.1 + 0.2, 0.6, 4);
  REQUIRE(ticks.size() == 4);
  CHECK(ticks.front() == Approx(0.3));
  CHECK(ticks.back() == Approx(0.6));
}

TEST_CASE("tick labels share their decimals and a factor") {
  CHECK(linear_tick_labels({-0.5, 0, 0.5}).labels == std::vector<std::string>{"−0.5", "0.0", "0.5"});
  CHECK(linear_tick_labels({0, 20, 40}).labels == std::vector<std::string>{"0", "20", "40"});
  const TickLabels small = linear_tick_labels({0, 2e-5, 4e-5});
  CHECK(small.labels == std::vector<std::string>{"0", "2", "4"});
  CHECK(small.factor == "×10⁻⁵");
  CHECK(linear_tick_labels({0, 5e6, 1e7}).factor == "×10⁷");
}

TEST_CASE("logarithmic ticks are decades, thinned where there are many and refined where there are few") {
  CHECK(log_ticks(1e-4, 1, 10).major.size() == 5);
  const auto thinned = log_ticks(1e-12, 1, 5).major;
  CHECK(thinned.size() <= 5);
  CHECK(thinned.size() >= 3);
  const auto refined = log_ticks(0.1, 1, 10).major;
  REQUIRE(refined.size() == 4);
  CHECK(refined[1] == Approx(0.2));
  CHECK(log_ticks(0.1, 1, 10).minor.size() == 6);
  CHECK(log_tick_labels({0.01, 0.1, 1}) == std::vector<std::string>{"0.01", "0.1", "1"});
  CHECK(log_tick_labels({1e-5, 2e-5, 1e-2}) == std::vector<std::string>{"10⁻⁵", "2×10⁻⁵", "10⁻²"});
}

TEST_CASE("labels that fit on an axis do not touch") {
  for (const double length : {30., 60., 150., 700.}) {
    for (const bool upright : {false, true}) {
      const Axis axis{-123.4, 56.7, false, ""};
      const AxisTicks ticks = fitting_ticks(axis, length, upright);
      REQUIRE(ticks.labels.size() == ticks.major.size());
      for (std::size_t i = 0; i + 1 < ticks.major.size(); ++i) {
        const double distance = length * (axis.fraction(ticks.major[i + 1]) - axis.fraction(ticks.major[i]));
        const Pixel a = text_extent(ticks.labels[i], tick_text),
                    b = text_extent(ticks.labels[i + 1], tick_text);
        CHECK(distance > 0.5 * (upright ? a.y + b.y : a.x + b.x));
      }
    }
  }
}
