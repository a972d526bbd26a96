#include "solver/reference/exact/finite_strain_column.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "solver/reference/exact/conventional_column.hpp"
#include "tests/unit/solver/reference/exact/columns.hpp"

using namespace porosph;

namespace {

/// sigma'/M and present height while walking down the initial heights.
struct State {
  double s, present;
};

/// Weight less buoyancy where the place is below the water *now*; weight as the place was saturated at first.
State slope(const Column& c, double initial, const State& state) {
  const double weight = initial < c.water_level ? c.unit_weight_saturated : c.unit_weight_unsaturated;
  const double buoyancy = state.present < c.water_level ? c.unit_weight_water * std::exp(state.s) : 0;
  return {(weight - buoyancy) / c.constrained_modulus(), std::exp(state.s)};
}

/// Fourth-order Runge-Kutta from the ground, taken to lie at `ground`, down to an initial height.
State march(const Column& c, double surface_s, double ground, double to, int steps) {
  State state{surface_s, ground};
  const double d = (to - c.height) / steps;
  for (int i = 0; i < steps; ++i) {
    const double y = c.height + i * d;
    const State k1 = slope(c, y, state);
    const State k2 = slope(c, y + d / 2, {state.s + d / 2 * k1.s, state.present + d / 2 * k1.present});
    const State k3 = slope(c, y + d / 2, {state.s + d / 2 * k2.s, state.present + d / 2 * k2.present});
    const State k4 = slope(c, y + d, {state.s + d * k3.s, state.present + d * k3.present});
    state.s += d / 6 * (k1.s + 2 * k2.s + 2 * k3.s + k4.s);
    state.present += d / 6 * (k1.present + 2 * k2.present + 2 * k3.present + k4.present);
  }
  return state;
}

/// The height of the ground for which the bottom comes to lie at zero, by bisection.
double find_ground(const Column& c, int steps) {
  double low = 0, high = 2 * c.height;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (march(c, 0, middle, 0, steps).present > 0 ? high : low) = middle;
  }
  return low;
}

}  // namespace

TEST_CASE("the submerged column agrees with numerical integration") {
  for (const Column& c : {foundation(), soft_foundation()}) {
    const FiniteStrainColumn exact(c);
    const double ground = find_ground(c, 1000);
    CHECK(exact.settlement() == Approx(c.height - ground).epsilon(1e-9));
    for (const double y : {0.0, 2.5, 7.0}) {
      const State state = march(c, 0, ground, y, 1000);
      CHECK(exact.vertical_stress(y) == Approx(c.constrained_modulus() * state.s).epsilon(1e-10));
      CHECK(exact.displacement(y) == Approx(state.present - y).epsilon(1e-8).margin(1e-12));
    }
    CHECK(exact.vertical_stress(c.height) == 0);
    CHECK(exact.displacement(0) == 0);
  }
}

TEST_CASE("partly wet and dry columns agree with numerical integration") {
  for (const double level : {6.0, 9.9, -1.0}) {
    Column c = soft_foundation();
    c.water_level = level;
    const FiniteStrainColumn exact(c);
    const int steps = 10000;  // the weight jumps within a step
    const double ground = find_ground(c, steps);
    CHECK(exact.settlement() == Approx(c.height - ground).epsilon(1e-4));
    for (const double y : {0.0, 3.0, 5.95, 8.0})
      CHECK(exact.vertical_stress(y) ==
            Approx(c.constrained_modulus() * march(c, 0, ground, y, steps).s).epsilon(1e-4));
  }
}

TEST_CASE("soil that sinks below the water level becomes buoyant") {
  Column c = soft_foundation();
  c.water_level = 6;
  const FiniteStrainColumn exact(c);
  const auto slope_at = [&](double y) {
    return (exact.vertical_stress(y + 1e-5) - exact.vertical_stress(y - 1e-5)) / 2e-5;
  };
  const double sunk = -exact.displacement(6);
  REQUIRE(sunk > 0.1);
  CHECK(slope_at(6 + 3 * sunk) == Approx(c.unit_weight_unsaturated));
  const double stretch = std::exp(exact.vertical_stress(6 + 0.5 * sunk) / c.constrained_modulus());
  CHECK(slope_at(6 + 0.5 * sunk) == Approx(c.unit_weight_unsaturated - c.unit_weight_water * stretch));
}

TEST_CASE("a column that sinks below the water level as a whole") {
  Column c = soft_foundation();
  c.water_level = 9.99;
  const FiniteStrainColumn exact(c);
  REQUIRE(exact.settlement() > 0.01);
  const double top_slope = exact.vertical_stress(10 - 1e-5) / -1e-5;
  CHECK(top_slope == Approx(c.unit_weight_unsaturated - c.unit_weight_water).epsilon(1e-4));
}

TEST_CASE("small strains give the textbook's line, wet, partly wet and dry") {
  for (const double level : {15.0, 6.0, -never}) {
    Column c = foundation();
    c.water_level = level;
    c.bulk_modulus *= 1e6;
    c.shear_modulus *= 1e6;
    const FiniteStrainColumn exact(c);
    for (const double y : {0.0, 3.0, 6.0, 8.0})
      CHECK(exact.vertical_stress(y) == Approx(textbook_vertical_stress(c, y)).epsilon(1e-6));
  }
  Column c = foundation();
  CHECK(textbook_vertical_stress(c, 5) == Approx(-(20e3 - 9810) * 5));
  c.water_level = 6;
  CHECK(textbook_vertical_stress(c, 2) == Approx(-18.6e3 * 4 - (20e3 - 9810) * 4));
}

TEST_CASE("the foundation differs from the textbook by 0.22 % at its bottom, and settles 23 mm") {
  const FiniteStrainColumn exact(foundation());
  CHECK(exact.vertical_stress(0) / textbook_vertical_stress(foundation(), 0) == Approx(1.0022).margin(5e-5));
  CHECK(exact.settlement() == Approx(0.023).margin(5e-4));
}

TEST_CASE("lateral stress is nu / (1 - nu) of the vertical one") {
  const FiniteStrainColumn exact(foundation());
  CHECK(exact.lateral_stress(3) == Approx(0.33 / 0.67 * exact.vertical_stress(3)));
}

TEST_CASE("the conventional state carries the water's push as tension at its ground") {
  const Column c = foundation();
  const FiniteStrainColumn wrong = conventional_column(c);
  const double depth = c.water_level - (c.height - wrong.settlement());
  CHECK(wrong.vertical_stress(c.height) == Approx(c.unit_weight_water * depth));
  CHECK(wrong.vertical_stress(5) == Approx(-50.95e3 + 49.05e3).margin(100));
  CHECK(std::abs(wrong.settlement()) < 2e-3);  // instead of 23 mm
  const State bottom = march(c, wrong.vertical_stress(c.height) / c.constrained_modulus(),
                             c.height - wrong.settlement(), 0, 1000);
  CHECK(bottom.present == Approx(0).margin(1e-9));
  CHECK(wrong.vertical_stress(0) == Approx(c.constrained_modulus() * bottom.s));
}

TEST_CASE("without water above the ground the conventional state is the exact one") {
  Column c = foundation();
  c.water_level = 6;
  CHECK(conventional_column(c).vertical_stress(2) == FiniteStrainColumn(c).vertical_stress(2));
}

TEST_CASE("columns without a state of rest are refused") {
  Column c = foundation();
  c.unit_weight_saturated = 9000;
  CHECK_THROWS_AS(FiniteStrainColumn(c), std::invalid_argument);
  c = foundation();
  c.bulk_modulus = 0;
  CHECK_THROWS_WITH(FiniteStrainColumn(c), Catch::Contains("moduli"));
}
