#include "solver/run/consolidation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "solver/case/case_file.hpp"

using namespace porosph;

namespace {

constexpr double height = 4;

/// A column between rollers under its own weight and water, which drains at its top.
Case column(int rows, Arrangement arrangement, double permeability = 1e-9) {
  const double width = 4 * height / rows;
  Case scene;
  SoilCase soil;
  soil.name = "clay";
  soil.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  soil.youngs_modulus = 100e6;  // so that strains stay small, as the exact solution has them
  soil.poissons_ratio = 0.25;
  soil.unit_weight_saturated = 16e3;
  soil.unit_weight_unsaturated = 16e3;
  soil.permeability = {permeability, permeability};
  scene.soils = {soil};
  scene.water.mode = WaterMode::coupled;
  scene.water.stretches = {{-never, never, height + 0.5}};
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.particles.spacing = height / rows;
  scene.particles.arrangement = arrangement;
  scene.particles.smoothing_ratio = 1;
  scene.boundaries = {{BoundaryKind::roller, {0, 0}, {0, height}},
                      {BoundaryKind::roller, {width, 0}, {width, height}},
                      {BoundaryKind::fixed, {0, 0}, {width, 0}}};
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_control = 0.05;
  return scene;
}

struct Column {
  explicit Column(const Case& scene_) : scene(scene_), model(build_model(scene)) {
    dynamics = make_dynamics(scene.formulation, model);
    const double dt = 0.9 * model.smoothing_length / model.wave_speed;
    water = std::make_unique<Consolidation>(scene, model, *dynamics, dt);
  }
  double modulus() const { return model.soils[0].constrained_modulus(); }
  double buoyant() const { return scene.soils[0].unit_weight_saturated - scene.water.unit_weight; }
  double time_of(double factor) const {  ///< c_v t / H^2 = factor
    return factor * height * height * scene.water.unit_weight / (scene.soils[0].permeability.y() * modulus());
  }
  void run_to(double until) {
    while (now < until) now = water->advance(now, until);
  }
  /// Excess pressure over gamma' H.
  double excess(std::size_t a) const {
    return scene.water.unit_weight * water->head()[a] / (buoyant() * height);
  }
  double settlement() const {
    double lowest = 0;
    for (std::size_t a = 0; a < model.particles.size(); ++a)
      lowest = std::min(lowest, model.particles.displacement(a).y());
    return -lowest;
  }
  /// Relative L2 error of the excess pressure against Terzaghi's series for a start that grows with depth.
  double error(double factor) const {
    double error = 0, size = 0;
    for (std::size_t a = 0; a < model.particles.size(); ++a) {
      const double depth = 1 - model.particles.start[a].y() / height;
      double exact = 0;
      for (int m = 0; m < 200; ++m) {
        const double root = (2 * m + 1) * std::numbers::pi / 2;
        exact +=
            (m % 2 == 0 ? 2 : -2) / (root * root) * std::sin(root * depth) * std::exp(-root * root * factor);
      }
      error += std::pow(excess(a) - exact, 2), size += exact * exact;
    }
    return std::sqrt(error / size);
  }
  double degree(double factor) const {
    double left = 0;
    for (int m = 0; m < 200; ++m) {
      const double root = (2 * m + 1) * std::numbers::pi / 2;
      left += (m % 2 == 0 ? 4 : -4) / (root * root * root) * std::exp(-root * root * factor);
    }
    return 1 - left;
  }

  Case scene;
  Model model;
  std::unique_ptr<Dynamics> dynamics;
  std::unique_ptr<Consolidation> water;
  double now = 0;
};

}  // namespace

TEST_CASE("a column consolidates under its weight as Terzaghi has it", "[water][consolidation]") {
  const Arrangement arrangement = GENERATE(Arrangement::surface, Arrangement::stretched);
  Column c(column(20, arrangement));
  const double last = c.buoyant() * height * height / (2 * c.modulus());
  for (const double factor : {0.1, 0.2, 0.5, 0.848}) {
    c.run_to(c.time_of(factor));
    CAPTURE(static_cast<int>(arrangement), factor, c.error(factor), c.water->counts().soil_sweeps);
    CHECK(c.error(factor) < 0.006);
    CHECK(c.settlement() / last == Approx(c.degree(factor)).margin(0.004));
    CHECK(std::abs(c.water->imbalance()) < 1e-8 * c.water->drained());
  }
}

TEST_CASE("how long consolidation computes does not hang on permeability", "[water][consolidation]") {
  const auto sweeps = [](double permeability) {
    Column c(column(10, Arrangement::surface, permeability));
    c.run_to(c.time_of(0.2));
    return c.water->counts().soil_sweeps;
  };
  const std::int64_t usual = sweeps(1e-9);
  for (const double k : {1e-12, 1e-6, 1e-2})
    CHECK(static_cast<double>(sweeps(k)) == Approx(usual).epsilon(0.02));
}

TEST_CASE("compressible water takes up Skempton's part of a load at once", "[water][consolidation]") {
  const double bulk_modulus = GENERATE(1e7, 1e9);
  Case scene = column(10, Arrangement::surface);
  scene.water.coupling.bulk_modulus = bulk_modulus;
  scene.soils[0].porosity = 0.5;
  scene.water.coupling.first_step = 1e-3;  // nothing has drained
  Column c(scene);
  c.water->advance(0, 1e-3);
  const double water = bulk_modulus / 0.5, part = water / (c.modulus() + water);
  for (std::size_t a = 0; a < c.model.particles.size(); ++a) {
    const double depth = 1 - c.model.particles.start[a].y() / height;
    if (depth > 0.2) CHECK(c.excess(a) == Approx(part * depth).margin(0.01));
  }
}
