// Earth pressure on a smooth wall that moves: Rankine's.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double weight = 20e3, height = 2;

/// Mean force on the wall while it moves [N/m].
double earth_pressure(const Settings& settings) {
  Simulation s(scene("rankine", settings));
  return mean_force_on_footing(s, 0);
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
