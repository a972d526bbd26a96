#include "solver/reference/exact/dynamic_column.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

using namespace porosph;

namespace {

/// The paper's foundation: settles 23 mm, period 0.38 s.
DynamicColumn foundation_column(double damping) { return {10, 22.2e6, 20e3 / 9.81, 10.19e3, damping}; }

/// Displacement and stress at mid-height by central differences in space and time.
std::pair<double, double> finite_differences(const DynamicColumn& column, int cells, double end) {
  const double dy = column.height / cells, c = column.wave_speed();
  const int steps = static_cast<int>(std::ceil(end * c / (0.999 * dy)));
  const double dt = end / steps, a = column.damping * dt / 2;
  std::vector<double> before(cells + 1, 0.0), now(cells + 1, 0.0), after(cells + 1, 0.0);
  for (int step = 0; step < steps; ++step) {
    for (int i = 1; i <= cells; ++i) {
      const double above = i < cells ? now[i + 1] : now[i - 1];  // free: mirrored
      const double force =
          column.modulus * (above - 2 * now[i] + now[i - 1]) / (dy * dy) - column.unit_weight;
      const double acceleration = force / column.density * dt * dt;
      after[i] = step == 0 ? acceleration / 2 : (2 * now[i] - (1 - a) * before[i] + acceleration) / (1 + a);
    }
    before = std::exchange(now, after);
  }
  const int middle = cells / 2;
  return {now[middle], column.modulus * (now[middle + 1] - now[middle - 1]) / (2 * dy)};
}

}  // namespace

TEST_CASE("agrees with finite differences, from no damping to strong damping") {
  // 2 omega_1 = 32.8 /s is critical for the first mode, 2 omega_2 = 98.3 /s for the second
  for (const double damping : {0.0, 4.4, 32.8, 60.0, 300.0}) {
    const DynamicColumn column = foundation_column(damping);
    for (const double time : {0.03, 0.21, 0.76}) {
      const auto [displacement, stress] = finite_differences(column, 1000, time);
      CHECK(column.displacement(5, time) == Approx(displacement).epsilon(2e-4).margin(2e-7));
      CHECK(column.vertical_stress(5, time) == Approx(stress).epsilon(1e-3).margin(20));
    }
  }
}

TEST_CASE("starts at rest without stress") {
  for (const double damping : {0.0, 4.4, 60.0})
    for (const double y : {0.0, 3.0, 10.0}) {
      CHECK(foundation_column(damping).displacement(y, 0) == Approx(0).margin(1e-15));
      CHECK(foundation_column(damping).vertical_stress(y, 0) == Approx(0).margin(1e-3));
      CHECK(foundation_column(damping).displacement(y, 1e-4) == Approx(0).margin(1e-7));
    }
}

TEST_CASE("swings undamped to twice the static state with period 4H/c") {
  const DynamicColumn column = foundation_column(0);
  const double half = column.period() / 2;
  const double settlement = -10.19e3 / 22.2e6 * 10 * 10 / 2;
  CHECK(column.period() == Approx(4 * 10 / std::sqrt(22.2e6 * 9.81 / 20e3)));
  CHECK(column.displacement(10, half) == Approx(2 * settlement));
  CHECK(column.vertical_stress(0, half) == Approx(-2 * 10.19e3 * 10));
  CHECK(column.displacement(10, 7 * 2 * half) == Approx(0).margin(1e-12));
  CHECK(column.vertical_stress(4, 0.1) == Approx(column.vertical_stress(4, 0.1 + 6 * half)));
}

TEST_CASE("comes to rest at the static state, soon or late") {
  for (const double damping : {4.4, 32.8, 300.0}) {
    const DynamicColumn column = foundation_column(damping);
    CHECK(column.vertical_stress(5, 40) == Approx(-10.19e3 * 5).epsilon(1e-9));
    CHECK(column.displacement(10, 40) == Approx(-10.19e3 / 22.2e6 * 50).epsilon(1e-9));
  }
}

TEST_CASE("the ends are free and fixed at all times") {
  for (const double time : {0.05, 0.3}) {
    CHECK(foundation_column(4.4).vertical_stress(10, time) == Approx(0).margin(1e-3));
    CHECK(foundation_column(4.4).displacement(0, time) == Approx(0).margin(1e-15));
  }
}

TEST_CASE("undamped energy stays zero: kinetic, elastic and of position") {
  const DynamicColumn column = foundation_column(0);
  const int cells = 2000;
  for (const double time : {0.04, 0.123, 0.3}) {
    double kinetic = 0, elastic = 0, position = 0;
    for (int i = 0; i < cells; ++i) {
      const double y = (i + 0.5) * 10 / cells, dt = 1e-6;
      const double velocity =
          (column.displacement(y, time + dt) - column.displacement(y, time - dt)) / (2 * dt);
      const double stress = column.vertical_stress(y, time);
      kinetic += column.density * velocity * velocity / 2;
      elastic += stress * stress / (2 * column.modulus);
      position += column.unit_weight * column.displacement(y, time);
    }
    CHECK(kinetic + elastic + position == Approx(0).margin(1e-4 * elastic));
  }
}

TEST_CASE("stress is the modulus times the slope of displacement, damped too") {
  const DynamicColumn column = foundation_column(60);
  for (const double time : {0.05, 0.2}) {
    const double slope = (column.displacement(4.001, time) - column.displacement(3.999, time)) / 0.002;
    CHECK(column.vertical_stress(4, time) == Approx(22.2e6 * slope).epsilon(1e-5));
  }
}

TEST_CASE("each mode decays by its own law, continuously through critical damping") {
  const double omega = 3, time = 0.7;
  const auto residual = [&](double damping) {
    const auto phi = [&](double t) { return DynamicColumn::decay(omega, damping, t); };
    const double d = 1e-4;
    const double rate = (phi(time + d) - phi(time - d)) / (2 * d);
    const double curvature = (phi(time + d) - 2 * phi(time) + phi(time - d)) / (d * d);
    return curvature + damping * rate + omega * omega * phi(time);
  };
  for (const double damping : {0.0, 1.0, 5.999, 6.0, 6.001, 9.0, 50.0}) {
    CHECK(DynamicColumn::decay(omega, damping, 0) == 1);
    CHECK(residual(damping) == Approx(0).margin(1e-5));
  }
  const double critical = (1 + omega * time) * std::exp(-omega * time);
  CHECK(DynamicColumn::decay(omega, 2 * omega, time) == Approx(critical));
  for (const double difference : {-1e-9, 1e-9})
    CHECK(DynamicColumn::decay(omega, 2 * omega + difference, time) == Approx(critical).epsilon(1e-8));
  CHECK(DynamicColumn::decay(3, 1e4, 1e3) == Approx(std::exp(-9.0 / 1e4 * 1e3)).epsilon(1e-5));
}
