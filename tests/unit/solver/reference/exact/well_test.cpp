#include "solver/reference/exact/well.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace porosph;

TEST_CASE("a well in the middle of a square reaches as far as its conformal map says", "[exact][well]") {
  const double gamma = std::tgamma(0.25);
  const double mapping_radius = 4 * std::sqrt(std::acos(-1.0)) / (gamma * gamma);  // of a side of 1
  CHECK(WellInRectangle({3, 3}, {1.5, 1.5}).reach() == Approx(3 * mapping_radius).epsilon(1e-12));
}

TEST_CASE("the head of a well in a rectangle is harmonic, symmetric, and level on all sides",
          "[exact][well]") {
  const Vec2 size{4, 2.5}, place{1.3, 0.8}, at{2.9, 1.9};
  const WellInRectangle well(size, place);
  for (const Vec2& side : {Vec2{0, 1}, Vec2{4, 0.3}, Vec2{1.7, 0}, Vec2{2.2, 2.5}})
    CHECK(well.drop(side) == Approx(0).margin(1e-12));
  CHECK(well.drop(at) == Approx(WellInRectangle(size, at).drop(place)).epsilon(1e-12));
  CHECK(well.drop(at) == Approx(WellInRectangle({2.5, 4}, {0.8, 1.3}).drop({1.9, 2.9})).epsilon(1e-9));
  constexpr double step = 0.01;
  const Vec2 x{step, 0}, y{0, step};
  const double around = (well.drop(at + x) + well.drop(at - x) + well.drop(at + y) + well.drop(at - y)) / 4;
  CHECK(around == Approx(well.drop(at)).epsilon(1e-7));
  const Vec2 near = place + Vec2{6e-6, 8e-6};
  CHECK(well.drop(near) == Approx(std::log(well.reach() / 1e-5)).epsilon(1e-5));
}
