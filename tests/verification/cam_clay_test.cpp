// A layer of modified Cam-clay under its weight.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/element/element_test.hpp"
#include "solver/model/soil_law.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double height = 4, weight = 16e3, attraction = 4e3;

Case layer(double spacing, double preconsolidation) {
  Case scene = box_of_soil(4, static_cast<int>(std::lround(height / spacing)), spacing);
  hold_as_column(scene);
  SoilCase& soil = scene.soils[0];
  soil.youngs_modulus = 20e6, soil.poissons_ratio = 0.25;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = weight;
  soil.law = LawKind::cam_clay;
  soil.cam_clay = {.ratio = 1,
                   .lambda = 0.1,
                   .kappa = 0.02,
                   .void_ratio = 1,
                   .preconsolidation = preconsolidation,
                   .attraction = attraction};
  scene.particles.arrangement = Arrangement::surface;
  scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.adaptive_damping = true;
  scene.stop.on_separation = false;
  scene.time.courant = 0.5, scene.time.end = 60;
  return scene;
}

/// Comes to rest; the largest errors of vertical stress over its largest value, and of the surface's
/// settlement over its own, where `strain` is the axial compression under a vertical effective stress.
struct Errors {
  double stress = 0, settlement = 0;
};
template <class Strain>
Errors at_rest(const Case& scene, Strain&& strain) {
  Simulation simulation(scene);
  double ratio = 1;
  while (simulation.step() < simulation.last_step() && ratio > 1e-6) {
    for (int k = 0; k < 100; ++k) simulation.advance();
    REQUIRE_FALSE(simulation.instability());
    ratio = simulation.unbalanced_force_ratio();
  }
  CHECK(ratio < 1e-6);
  // Each piece of soil keeps its weight and shortens by exp(-strain): from the base up.
  const auto settled = [&](double y) {
    constexpr int pieces = 2000;
    double sum = 0;
    for (int k = 0; k < pieces; ++k)
      sum += (1 - std::exp(-strain(weight * (height - y * (k + 0.5) / pieces)))) * y / pieces;
    return sum;
  };
  const Particles& p = simulation.model().particles;
  Errors e;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double depth = height - p.start[a].y();
    e.stress = std::max(e.stress, std::abs(p.stress[a].yy + weight * depth) / (weight * height));
    const double expected = settled(p.start[a].y());
    e.settlement =
        std::max(e.settlement, std::abs(p.start[a].y() - p.position[a].y() - expected) / settled(height));
  }
  return e;
}

}  // namespace

TEST_CASE("overconsolidated Cam-clay settles along its swelling line", "[cam_clay]") {
  // Elastic: p' = (1 + nu) / (3 (1 - nu)) of the vertical stress, the strain kappa* ln(P / attraction).
  const double nu = 0.25, share = (1 + nu) / (3 * (1 - nu));
  const auto strain = [&](double stress) { return 0.01 * std::log(1 + share * stress / attraction); };
  const Errors shipped = at_rest(scene("cam_clay_layer"), strain);
  expect({.name = "cam_clay_layer",
          .settings = {},
          .quantity = "vertical effective stress at rest, largest error over the largest stress",
          .reference = "weight above",
          .resolution = metres(0.2)},
         shipped.stress, 0.01);
  expect({.name = "cam_clay_layer",
          .settings = {},
          .quantity = "settlement at rest, largest error over that of the surface",
          .reference = "kappa* ln(P / attraction), summed up",
          .resolution = metres(0.2)},
         shipped.settlement, 0.01);
  const Errors coarse = at_rest(layer(0.4, 1e6), strain), fine = at_rest(layer(0.2, 1e6), strain);
  CAPTURE(coarse.stress, coarse.settlement, fine.stress, fine.settlement);
  CHECK(coarse.stress < 0.012);  // it alternates from row to row
  CHECK(fine.stress < 0.01);
  // The top row has the largest error; in the fine layer it is nearer to the surface, where it is softer.
  CHECK(coarse.settlement < 0.0085);
  CHECK(fine.settlement < 0.0085);
}

TEST_CASE("a layer of Cam-clay settles by the strain of an oedometer test", "[cam_clay]") {
  const Case scene = layer(0.2, 10e3);
  ElementSetup setup{.test = ElementTest::oedometer,
                     .axial_stress = 0,
                     .radial_stress = 0,
                     .targets = {weight * height},
                     .by_stress = true,
                     .steps = 4000};
  const ElementPath path = run_element_test(soil_law(scene.soils[0], 1), setup);
  const auto strain = [&](double stress) {
    const double place = stress / (weight * height) * setup.steps;
    const auto k = std::min(static_cast<std::size_t>(place), path.states.size() - 2);
    const double low = path.strain(path.states[k]), high = path.strain(path.states[k + 1]);
    return low + (place - static_cast<double>(k)) * (high - low);
  };
  const Errors e = at_rest(scene, strain);
  CAPTURE(e.stress, e.settlement);
  CHECK(e.stress < 0.005);
  CHECK(e.settlement < 0.01);
}
