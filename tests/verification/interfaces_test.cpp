// Soils of different stiffness on each other: stress by the weight above, displacements without a zigzag.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "solver/run/monitor/zigzag.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// Stiff soil of 2 m on soft soil of `rows` rows of 0.2 m, between rollers, at rest.
Simulation stiff_on_soft(int rows, double contrast) {
  const double depth = 0.2 * rows, top = depth + 2;
  Case scene = box_of_soil(20, rows, 0.2);
  scene.formulation = default_formulation(Motion::consistent);
  SoilCase stiff = scene.soils[0];
  scene.soils[0].youngs_modulus = 1e6, stiff.youngs_modulus = contrast * 1e6;
  scene.soils[0].poissons_ratio = stiff.poissons_ratio = 0.3;
  scene.soils[0].unit_weight_unsaturated = stiff.unit_weight_unsaturated = 20e3;
  stiff.name = "stiff", stiff.polygon = box_outline(0, depth, 4, top);
  scene.soils.push_back(stiff);
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {4, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, top});
  add_wall(scene, BoundaryKind::roller, {4, 0}, {4, top});
  scene.loading.adaptive_damping = true;
  scene.time.courant = 0.9, scene.time.end = 20;
  scene.stop.unbalanced_force_ratio = 1e-5;
  Simulation simulation(scene);
  run_to_end(simulation);
  return simulation;
}

/// The layered embankment with a soft layer of 8 MPa between soils of `contrast` times that, and half of it.
Simulation layered_embankment(const std::string& arrangement, double contrast, double spacing) {
  Settings settings = {"particles.arrangement=" + arrangement,
                       fmt::format("particles.spacing={}", spacing),
                       fmt::format("soil.gravel.youngs_modulus={}", 8e6 * contrast),
                       fmt::format("soil.fill.youngs_modulus={}", 8e6 * std::max(1.0, contrast / 2)),
                       "loading.damping=adaptive",
                       "time.end=1000",
                       "stop.unbalanced_force_ratio=1e-5"};
  if (arrangement == "disordered") settings.push_back("particles.disorder=0.1");
  if (arrangement == "surface") settings.push_back("particles.smoothing_ratio=1.0");
  return Simulation(scene("embankment_layered", settings));
}

}  // namespace

TEST_CASE("a soft layer carries the weight above it, however stiff that is", "[interfaces]") {
  const int rows = GENERATE(3, 6);
  const double contrast = GENERATE(1.0, 10.0, 1e3);
  CAPTURE(rows, contrast);
  const Simulation simulation = stiff_on_soft(rows, contrast);
  const Particles& p = simulation.model().particles;
  const double top = 0.2 * rows + 2, soft_modulus = Elasticity::from_young(1e6, 0.3).constrained_modulus();
  double worst = 0, settlement = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.soil[i] == 1) continue;
    // The ground settles by some per cent of the layer, by which the load is no longer that of small strain.
    worst = std::max(worst, std::abs(p.stress[i].yy / (-20e3 * (top - p.start[i].y())) - 1));
    settlement = std::min(settlement, p.displacement(i).y());
  }
  CHECK(worst < 0.01);
  const double depth = 0.2 * rows, upper_row = depth - 0.1;
  const double exact = -20e3 / soft_modulus * (top * upper_row - 0.5 * upper_row * upper_row);
  CHECK(settlement == Approx(exact).epsilon(0.05));  // small strain, of up to 5 %
}

TEST_CASE("displacements of a layered embankment do not zigzag", "[interfaces]") {
  const char* arrangement = GENERATE("lattice", "fitted");
  CAPTURE(arrangement);
  Simulation simulation(scene("embankment_layered",
                              {"particles.spacing=0.4", "time.end=3", "time.courant=0.9",
                               "loading.damping=0.02", std::string("particles.arrangement=") + arrangement}));
  double half_way = 0;
  while (simulation.step() < simulation.last_step()) {
    simulation.advance();
    REQUIRE_FALSE(simulation.instability());
    if (2 * simulation.step() == simulation.last_step() / 2 * 2)
      half_way = measure_zigzag(simulation.model()).rms;
  }
  const Zigzag at_rest = measure_zigzag(simulation.model());
  CHECK(at_rest.rms < 0.02);
  CHECK(at_rest.quantile < 0.1);
  CHECK(at_rest.rms < 1.05 * half_way + 1e-3);
}

TEST_CASE("layered embankments do not zigzag, whatever the arrangement and the contrast", "[interfaces]") {
  const std::string arrangement = GENERATE("lattice", "fitted", "surface", "disordered");
  const double contrast = GENERATE(1.0, 100.0);
  CAPTURE(arrangement, contrast);
  Simulation simulation = layered_embankment(arrangement, contrast, 0.3);
  run_to_end(simulation);
  const Zigzag at_rest = measure_zigzag(simulation.model());
  CHECK(at_rest.rms < 0.02);
  CHECK(at_rest.quantile < 0.1);
  for (auto left = simulation.step(); left > 0; --left) simulation.advance();
  CHECK(measure_zigzag(simulation.model()).rms < 1.02 * at_rest.rms);
}

// Half an hour: for a night. docs/theory.md has what was measured.
TEST_CASE("no zigzag grows over a million steps", "[.nightly]") {
  const std::string arrangement = GENERATE("lattice", "fitted", "surface", "disordered");
  const double contrast = GENERATE(1.0, 1e4);
  CAPTURE(arrangement, contrast);
  Simulation simulation = layered_embankment(arrangement, contrast, 0.5);  // rows fit the layers
  while (simulation.step() < 250000) simulation.advance();
  const Zigzag early = measure_zigzag(simulation.model());
  while (simulation.step() < 1000000) simulation.advance();
  const Zigzag late = measure_zigzag(simulation.model());
  WARN(arrangement << ", contrast " << contrast << ": after a quarter " << early.rms << ", " << early.quantile
                   << ", after a million steps " << late.rms << ", " << late.quantile);
  CHECK(late.rms < 0.02);
  CHECK(late.quantile < 0.1);
  CHECK(late.rms < 1.001 * early.rms);
  CHECK(late.quantile < 1.001 * early.quantile);
}
