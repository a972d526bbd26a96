#include "solver/reference/fem/consolidation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes.hpp"
#include "solver/reference/exact/consolidation.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

constexpr double weight = 9810;

/// Of clay that weighs no more than water, which stands at its top.
Case clay(double width, double height) {
  Case scene;
  SoilCase soil;
  soil.name = "clay";
  soil.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  soil.youngs_modulus = 10e6;
  soil.poissons_ratio = 0.2;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = weight;
  soil.permeability = {1e-8, 1e-8};
  scene.soils = {soil};
  scene.water.mode = WaterMode::coupled;
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.water.stretches = {{-never, never, height}};
  scene.particles.spacing = height / 20;
  return scene;
}

Case column(double load = 10e3) {
  Case scene = clay(1, 4);
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 4}},
                      {BoundaryKind::roller, {1, 0}, {1, 4}},
                      {BoundaryKind::fixed, {0, 0}, {1, 0}}};
  scene.loads = {
      {.name = "load", .from = {0, 4}, .to = {1, 4}, .pressure = load, .pressure_to = load, .over_time = {}}};
  return scene;
}

double diffusivity(const Case& scene) {
  return scene.soils[0].permeability.y() * test::constrained_modulus(scene.soils[0]) / weight;
}

double excess(const FemSolution& s, const Point& p, double level) {
  return -s.at(p).pore_pressure - weight * (level - p.y());
}

struct Errors {
  double pressure = 0, settlement = 0;  ///< largest, over the load and over the last settlement
};

Errors errors_of_column(double h, double factor) {
  const Case scene = column();
  const double last = 10e3 * 4 / test::constrained_modulus(scene.soils[0]);
  Errors errors;
  consolidate_by_fem(
      scene, mesh_rectangle(scene, h), {factor * 16 / diffusivity(scene)}, [&](double, const FemSolution& s) {
        for (double y = 0; y < 4; y += 0.1)
          errors.pressure = std::max(errors.pressure, std::abs(excess(s, {0.3, y}, 4) / 10e3 -
                                                               terzaghi_pressure(1 - y / 4, factor)));
        errors.settlement = std::abs(-s.at({0.5, 4}).displacement.y() / last - terzaghi_degree(factor));
      });
  return errors;
}

}  // namespace

TEST_CASE("finite elements consolidate a layer as Terzaghi says, with high order", "[fem][water]") {
  for (const double factor : {0.1, 0.5}) {
    const Errors coarse = errors_of_column(2, factor), fine = errors_of_column(1, factor),
                 finest = errors_of_column(0.5, factor);
    CAPTURE(factor, coarse.pressure, fine.pressure, finest.pressure, coarse.settlement, fine.settlement,
            finest.settlement);
    CHECK(fine.pressure < coarse.pressure / 6);
    CHECK(finest.pressure < fine.pressure / 5);
    CHECK(finest.pressure < 2e-4);
    CHECK(fine.settlement < coarse.settlement / 25);
    CHECK(finest.settlement < 3e-6);  // steps in time are left
  }
}

TEST_CASE("finite elements know the pressure before water has left", "[fem][water]") {
  const double bulk = GENERATE(as<double>{}, CouplingCase::incompressible, 10e6);
  const WaterMode mode = GENERATE(WaterMode::coupled, WaterMode::undrained);
  Case scene = column();
  scene.water.mode = mode;
  scene.water.coupling.bulk_modulus = bulk;
  const double stiffness = test::constrained_modulus(scene.soils[0]), of_water = bulk / 0.4;
  const double share = std::isinf(bulk) ? 1 : of_water / (stiffness + of_water);
  consolidate_by_fem(scene, mesh_rectangle(scene, 1), {0}, [&](double, const FemSolution& s) {
    for (const double y : {0.0, 1.3, 3.9, 4.0}) {
      CHECK(excess(s, {0.5, y}, 4) == Approx(share * 10e3).epsilon(1e-7));
      CHECK(s.at({0.5, y}).displacement.y() ==
            Approx(-(1 - share) * 10e3 / stiffness * y).margin(1e-9 * 10e3 / stiffness));
    }
  });
}

TEST_CASE("finite elements follow a load that grows, and a flux", "[fem][water]") {
  Case scene = column();
  const double unit = 16 / diffusivity(scene);
  SECTION("a ramp is the sum of small loads") {
    scene.loads[0].over_time = {{0, 0}, {0.2 * unit, 1}};
    consolidate_by_fem(scene, mesh_rectangle(scene, 0.5), {0, 0.1 * unit, 0.2 * unit, 0.5 * unit},
                       [&](double time, const FemSolution& s) {
                         const double now = time / unit, y = 1;
                         double sum = 0;  // of the responses to steps, by the midpoint rule
                         constexpr int pieces = 4000;
                         const double ramp = std::min(now, 0.2);
                         for (int i = 0; i < pieces && now > 0; ++i)
                           sum += terzaghi_pressure(0.75, now - (i + 0.5) / pieces * ramp) / pieces *
                                  (ramp / 0.2);
                         CAPTURE(now);
                         CHECK(excess(s, {0.5, y}, 4) / 10e3 == Approx(sum).margin(2e-5));
                       });
  }
  SECTION("what enters at the bottom leaves at the top") {
    scene.loads.clear();
    scene.water.faces = {{.kind = FaceKind::flux, .from = {0, 0}, .to = {1, 0}, .rate = 1e-9}};
    consolidate_by_fem(scene, mesh_rectangle(scene, 1), {20 * unit}, [&](double, const FemSolution& s) {
      for (const double y : {0.0, 2.2, 4.0})
        CHECK(excess(s, {0.5, y}, 4) == Approx(weight * 0.1 * (4 - y)).epsilon(1e-6).margin(1e-6));
    });
  }
}

TEST_CASE("finite elements consolidate Mandel's specimen under a rigid plate", "[fem][water]") {
  Case scene = clay(4, 2);
  scene.water.faces = {{.kind = FaceKind::closed, .from = {0, 2}, .to = {4, 2}}};
  scene.footings = {
      {.name = "plate", .from = {0, 2}, .to = {4, 2}, .rough = false, .force = 20e3, .over_time = {}}};
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 3}}, {BoundaryKind::roller, {0, 0}, {5, 0}}};
  const Mandel exact(0.2);
  const double unit = 16 / diffusivity(scene), shear_modulus = 10e6 / 2.4;
  consolidate_by_fem(
      scene, mesh_rectangle(scene, 0.5), {0, 0.1 * unit, 0.5 * unit}, [&](double time, const FemSolution& s) {
        const double factor = time / unit;
        CAPTURE(factor);
        const double settled = -s.at({1, 2}).displacement.y();
        CHECK(-s.at({3, 2}).displacement.y() == Approx(settled).epsilon(1e-9));
        const double strain = 2 * shear_modulus * settled / 2 / 5e3;
        if (time == 0) {
          CHECK(strain == Approx(0.5).epsilon(1e-7));
          CHECK(excess(s, {1, 1}, 2) == Approx(2.5e3).epsilon(1e-6));
          return;
        }
        CHECK(strain == Approx(exact.strain(factor)).epsilon(1e-5));
        for (const double x : {0.0, 1.1, 2.0, 3.3, 3.9})
          CHECK(excess(s, {x, 1.2}, 2) / 5e3 == Approx(exact.pressure(x / 4, factor)).margin(1e-4));
      });
}

TEST_CASE("finite elements say what of a footing they do not know", "[fem]") {
  Case scene = clay(4, 2);
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, 3}}, {BoundaryKind::roller, {0, 0}, {5, 0}}};
  const auto ignore = [](double, const FemSolution&) {};
  scene.footings = {{.name = "plate", .from = {0, 2}, .to = {4, 2}, .settlement = 0.1, .over_time = {}}};
  CHECK_THROWS_WITH(consolidate_by_fem(scene, mesh_rectangle(scene, 1), {0}, ignore),
                    Contains("'plate' is driven by its settlement"));
  scene.footings = {{.name = "plate", .from = {0, 0}, .to = {4, 0}, .force = 1, .over_time = {}}};
  CHECK_THROWS_WITH(consolidate_by_fem(scene, mesh_rectangle(scene, 1), {0}, ignore),
                    Contains("holds the ground under footing 'plate'"));
}
