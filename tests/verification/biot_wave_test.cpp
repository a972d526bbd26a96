// Saturated soil in motion against the wave equation of Biot.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// Of an undrained column under a load that is put on at once: pressure behind the front over the load, and
/// the front's speed [m/s].
struct Wave {
  explicit Wave(const Simulation& s) {
    const SoilCase& soil = s.scene().soils[0];
    const double water = s.scene().water.coupling.bulk_modulus / 0.4;  // the usual porosity
    const double all = s.model().soils[0].constrained_modulus() + water;
    density = soil.unit_weight_saturated / s.scene().loading.gravity;
    carried = water / all, speed = std::sqrt(all / density);
  }
  double density, carried, speed;
};

}  // namespace

TEST_CASE("a step load runs down a column as an undrained wave of Biot", "[water][dynamic]") {
  Simulation s(scene("biot_wave"));
  run_to_end(s);
  const Wave wave(s);
  const Particles& p = s.model().particles;
  const double load = s.scene().loads[0].pressure;
  const auto velocity = s.velocities();
  double of_pressure = 0, of_velocity = 0, front = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double depth = 10 - p.start[a].y(), pressure = -s.water_in_motion()->excess()[a] / load;
    if (pressure > wave.carried / 2) front = std::max(front, depth + s.model().spacing / 2);  // its edge
    if (depth < 0.5 || depth > 2.5) continue;  // away from the load's edge and from the front
    of_pressure = std::max(of_pressure, std::abs(pressure / wave.carried - 1));
    of_velocity = std::max(of_velocity, std::abs(-velocity[a].y() * wave.density * wave.speed / load - 1));
  }
  const auto measured = [](const char* quantity) {
    return Measurement{.name = "biot_wave",
                       .settings = {},
                       .quantity = quantity,
                       .reference = "wave equation, undrained (Biot 1956)",
                       .resolution = metres(0.1)};
  };
  expect(measured("excess pore pressure behind the front, largest error"), of_pressure, 0.001);
  expect(measured("velocity of the soil behind the front, largest error"), of_velocity, 0.001);
  expect(measured("place of the front, over its way"), std::abs(front / (wave.speed * s.time()) - 1),
         0.1 / (wave.speed * s.time()));  // a spacing
}
