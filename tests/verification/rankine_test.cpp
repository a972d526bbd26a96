// Earth pressure on a wall that moves: Rankine's where it is smooth, Coulomb's where it is rough.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double weight = 20e3, height = 2, pi = std::numbers::pi;

/// Mean force on the wall while it moves [N/m].
double earth_pressure(const Settings& settings) {
  Simulation s(scene("rankine", settings));
  return mean_force_on_footing(s, 0);
}

/// Coulomb's horizontal K_a of an upright wall and level ground.
double coulomb(double phi, double delta) {
  const double root = std::sqrt(std::sin(phi + delta) * std::sin(phi) / std::cos(delta));
  return std::pow(std::cos(phi) / (1 + root), 2);
}

/// The same by bent slip lines. Where sand yields everywhere its stress grows with the distance r from the
/// wall's top: at an angle theta from the wall its middle is gamma r s, and the largest principal stress is
/// turned by psi from the radius. Equilibrium along and across the radius gives s' and psi'. At the first
/// radius that is a slip line Rankine's zone begins, whose stress tells s at the wall.
double by_slip_lines(double phi, double delta) {
  const double n = std::sin(phi), at_wall = -0.5 * (std::asin(std::sin(delta) / n) - delta);
  using State = Eigen::Vector2d;  // s, psi
  const auto rate = [n](double theta, const State& y) -> State {
    const double s = y[0], c = n * std::cos(2 * y[1]), q = n * std::sin(2 * y[1]);
    const double b1 = std::cos(theta) - s * (1 + 3 * c), b2 = -std::sin(theta) - 3 * s * q;
    const double det = 2 * s * (q * q - c * (1 - c));
    return {2 * s * (b1 * q - b2 * c) / det, (q * b2 - (1 - c) * b1) / det};
  };
  const auto over_rankine = [&](double s) {
    constexpr double h = 1e-4;
    State y(s, at_wall);
    double theta = 0;
    for (; std::cos(2 * y[1]) > n; theta += h) y += h * rate(theta + h / 2, y + h / 2 * rate(theta, y));
    return y[0] * (1 + n) / std::cos(theta);
  };
  double low = 0.7 / (1 + n), high = 1.2 / (1 + n);
  for (int k = 0; k < 30; ++k) (over_rankine((low + high) / 2) > 1 ? high : low) = (low + high) / 2;
  return low * (1 - n * std::cos(2 * at_wall));
}

}  // namespace

TEST_CASE("sand bears a smooth wall by Rankine's pressures", "[rankine]") {
  const bool passive = GENERATE(true, false);
  const double coefficient = passive ? 3 : 1.0 / 3;
  const Settings settings = passive ? Settings{} : Settings{"footing.0.settlement=-0.0006"};
  const double force = earth_pressure(settings);
  expect({.name = "rankine",
          .settings = settings,
          .quantity = passive ? "passive force on the wall" : "active force on the wall",
          .reference = passive ? "K_p gamma H^2 / 2" : "K_a gamma H^2 / 2",
          .resolution = metres(0.1)},
         std::abs(force / (0.5 * coefficient * weight * height * height) - 1), 0.005);
}

// Without dilation sand fails in bands at less than its friction angle: along a band that keeps its volume
// the shear stress is sin(phi) of the normal one (Davis 1968). With bands everywhere K_p is that of the angle
// whose tangent this is; a part of the soil that is at its strength does not lie in one.
TEST_CASE("sand that does not dilate bears a wall by less than Rankine's pressure", "[rankine]") {
  const double force = earth_pressure({"soil.0.dilation_angle=0"});
  const double angle = std::atan(0.5), least = (1 + std::sin(angle)) / (1 - std::sin(angle));
  const double coefficient = force / (0.5 * weight * height * height);
  CHECK(coefficient > least);
  CHECK(coefficient < 3);
}

TEST_CASE("cohesion adds 2 c sqrt(K) to the pressure of sand on a smooth wall", "[rankine]") {
  const double c = 5e3, force = earth_pressure({"soil.0.cohesion=5e3", "footing.0.settlement=0.004"});
  const double expected = 1.5 * weight * height * height + 2 * c * std::sqrt(3) * height;
  CHECK(force == Approx(expected).epsilon(0.005));
}

// Near a rough wall slip lines bend: Coulomb's plane wedge presses 1.2 % less than sand that dilates by its
// friction angle. The base holds a part of the lowest row, which a smooth wall tells from its force.
TEST_CASE("sand presses a wall that gives way by Coulomb's active pressure", "[rankine][sheet]") {
  const bool rough = GENERATE(true, false);
  const double phi = 30 * pi / 180, delta = rough ? 20 * pi / 180 : 0;
  const Settings settings = rough ? Settings{} : Settings{"sheet.wall.friction=0"};
  Simulation s(scene("retaining_wall", settings));
  REQUIRE(run(s, {}).status == RunStatus::equilibrium);
  s.accelerations();
  const Sheet::Profile profile = s.sheets()[0].profile();
  const Beam::Section& foot = profile.sections.front();
  const double k = std::abs(foot.shear) / (0.5 * weight * height * height), exact = coulomb(phi, delta);
  CHECK(exact == Approx(rough ? 0.27938 : 1.0 / 3).epsilon(1e-4));
  if (rough) CHECK(k == Approx(by_slip_lines(phi, delta)).epsilon(0.01));
  expect({.name = "retaining_wall",
          .settings = settings,
          .quantity = fmt::format("horizontal K_a, wall friction of {} degrees: {:.4f}", rough ? 20 : 0, k),
          .reference = fmt::format("{}: {:.4f}", rough ? "Coulomb, plane wedge" : "Rankine", exact),
          .resolution = metres(0.1)},
         std::abs(k / exact - 1), rough ? 0.015 : 0.025);
  const double dragged = std::abs(foot.axial) - 9.81 * profile.along.back();  // less its own weight
  CHECK(dragged == Approx(std::tan(delta) * std::abs(foot.shear)).epsilon(0.01).margin(1));
}
