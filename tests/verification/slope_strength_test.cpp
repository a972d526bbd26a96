// Strength of slopes, which the control of zero-energy motion must not raise.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// The homogeneous slope of Griffiths and Lane (1999), example 1: 10 m at 26.57 degrees, phi 20 degrees, c /
/// gamma H = 0.05, without dilation. Their factor of safety is 1.4.
Case slope(double stiffness) {
  Case scene = box_of_soil(2, 2, 1);
  SoilCase& soil = scene.soils[0];
  soil.polygon = {{0, 0}, {32, 0}, {12, 10}, {0, 10}};
  soil.youngs_modulus = 1e8, soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20e3;
  scene.particles.arrangement = Arrangement::fitted;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {32, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 10});
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_stiffness = stiffness;
  scene.formulation.closed_gradients = false;
  scene.formulation.refresh_strain = 0.1;
  scene.loading.adaptive_damping = true;
  scene.time.courant = 0.6, scene.time.end = 1.5;
  return scene;
}

/// Largest displacement when strength is divided by `factor`, over that of elastic soil.
double displacement(double stiffness, double factor) {
  const Case scene = slope(stiffness);
  const auto largest = [&](Simulation& simulation) {
    while (simulation.step() < simulation.last_step()) simulation.advance();
    const Particles& p = simulation.model().particles;
    double most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, p.displacement(i).norm());
    return most;
  };
  Simulation elastic(scene), yielding(scene);
  const double angle = std::atan(std::tan(20 * std::acos(-1) / 180) / factor) * 180 / std::acos(-1);
  yielding.set_law("soil",
                   DruckerPrager::from_mohr_coulomb(Elasticity::from_young(1e8, 0.3), 10e3 / factor, angle));
  return largest(yielding) / largest(elastic);
}

}  // namespace

TEST_CASE("a spring against zigzag adds no strength to a slope", "[slope]") {
  constexpr double by_default = -1;  // on, as the slope cuts cells
  for (const double factor : {1.3, 1.4, 1.5}) {
    CAPTURE(factor);
    const double with = displacement(by_default, factor), without = displacement(0, factor);
    // 0.3, 0.6 and 4.1 %; a spring that does not slip: 2, 19 and 61 %.
    CHECK(with == Approx(without).epsilon(factor < 1.45 ? 0.012 : 0.08));
  }
  CHECK(displacement(by_default, 1.5) > 3 * displacement(by_default, 1.4));
}
