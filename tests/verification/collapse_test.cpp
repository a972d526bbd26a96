// A column of soil that collapses and comes to rest.
#include <catch2/catch.hpp>
#include <functional>

#include "solver/run/energy_budget.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;

namespace {

/// The aluminium bars of Bui et al. (2008): 20 cm x 10 cm, friction 19.8 degrees, on a fixed base.
Case column(double spacing, double stiffness) {
  Case scene = box_of_soil(2, 2, spacing);
  SoilCase& soil = scene.soils[0];
  soil.polygon = box_outline(0, 0, 0.2, 0.1);
  soil.youngs_modulus = stiffness, soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20.4e3;
  soil.law = LawKind::drucker_prager;
  soil.strength.friction_angle = 19.8;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {0.7, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 0.12});
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_control = 0.1;
  scene.stop.on_separation = false;
  scene.time.courant = 0.8, scene.time.end = 1.2;
  return scene;
}

struct Deposit {
  double quantile95 = 0, mean = 0, lowest = 0, kinetic = 0, drop = 0, control = 0, unaccounted = 0;
};

Deposit deposit(const Case& scene) {
  Simulation simulation(scene);
  const double at_start = simulation.energy().total();
  while (simulation.step() < simulation.last_step() && !simulation.instability()) simulation.advance();
  REQUIRE_FALSE(simulation.instability());
  const Summary::EnergyBudget energy = energy_budget(simulation, at_start).value();
  const Particles& p = simulation.model().particles;
  Deposit d{.kinetic = energy.kinetic,
            .drop = energy.released,
            .control = energy.control,
            .unaccounted = energy.unaccounted};
  std::vector<double> x;
  d.lowest = never;
  for (const Vec2& at : p.position) {
    x.push_back(at.x()), d.lowest = std::min(d.lowest, at.y());
    d.mean += at.x() / static_cast<double>(p.size());
  }
  std::sort(x.begin(), x.end());
  d.quantile95 = x[x.size() * 95 / 100];
  return d;
}

}  // namespace

TEST_CASE("a column collapses, comes to rest, and the control takes little of its energy", "[collapse]") {
  const Deposit d = deposit(column(0.004, 0.84e6));
  CAPTURE(d.quantile95, d.mean, d.kinetic, d.drop, d.control, d.unaccounted, d.lowest);
  CHECK(d.lowest > 0.0008);  // walls stop particles at a quarter of the spacing; evening them out moves some
  CHECK(d.kinetic < 1e-5 * d.drop);
  CHECK(std::abs(d.unaccounted) < 0.01 * d.drop);
  CHECK(d.control > 0);
  CHECK(d.control < 0.1 * d.drop);
  CHECK(d.quantile95 == Approx(0.367).epsilon(0.02));
}

namespace {

constexpr double fine = 0.002, usual_spacing = 0.004, stiffness = 0.84e6;

/// After 0.65 s, when the flow is nearly over.
Deposit after(double spacing, const std::function<void(Case&)>& change) {
  Case scene = column(spacing, stiffness);
  scene.time.end = 0.65;
  change(scene);
  return deposit(scene);
}

void check_same(const Deposit& d, const Deposit& usual, double allowed) {
  CAPTURE(d.quantile95 / usual.quantile95, d.mean / usual.mean, d.unaccounted / d.drop);
  CHECK(d.quantile95 == Approx(usual.quantile95).epsilon(allowed));
  CHECK(d.mean == Approx(usual.mean).epsilon(allowed));
  CHECK(std::abs(d.unaccounted) < 0.01 * d.drop);
}

}  // namespace

TEST_CASE("how far a column goes does not depend on stiffness, time step or control", "[collapse]") {
  const Deposit usual = after(usual_spacing, [](Case&) {});
  const auto same = [&](const std::string& what, const std::function<void(Case&)>& change) {
    CAPTURE(what);
    check_same(after(usual_spacing, change), usual, 0.01);
  };
  same("stiffness x 3", [](Case& c) { c.soils[0].youngs_modulus *= 3; });
  same("stiffness x 10", [](Case& c) { c.soils[0].youngs_modulus *= 10; });
  same("Courant number 0.4", [](Case& c) { c.time.courant = 0.4; });
  same("control 0.02", [](Case& c) { c.formulation.zero_energy_control = 0.02; });
  same("control 0.2", [](Case& c) { c.formulation.zero_energy_control = 0.2; });
}

TEST_CASE("how far a column goes does not depend on the spacing", "[collapse][.nightly]") {
  const Deposit usual = after(usual_spacing, [](Case&) {}), finer = after(fine, [](Case&) {});
  check_same(finer, usual, 0.01);
  CHECK(finer.control < 0.05 * finer.drop);
}
