// A bank of soft clay that slumps while it keeps its water.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/energy_budget.hpp"
#include "solver/run/simulation.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

struct Deposit {
  double quantile95 = 0, mean = 0;  ///< of x [m]
  double displacement = 0, drained = 0, imbalance = 0, misfit = 0;
  Summary::EnergyBudget energy;
};

Deposit deposit(const Case& scene) {
  Simulation s(scene);
  const double at_start = s.energy().total();
  run_to_end(s);
  Deposit d{.displacement = s.largest_displacement(), .energy = energy_budget(s, at_start).value()};
  std::vector<double> x;
  for (const Vec2& at : s.model().particles.position) x.push_back(at.x());
  std::ranges::sort(x);
  d.quantile95 = x[x.size() * 95 / 100];
  for (const double one : x) d.mean += one / static_cast<double>(x.size());
  if (const DynamicWater* water = s.water_in_motion())
    d.drained = water->drained(), d.imbalance = water->imbalance(), d.misfit = water->misfit();
  return d;
}

/// Nothing of it sticks to the base: what walls do to clay has no part.
Case on_smooth_base() {
  Case clay = scene("failure/clay_slump", {"time.end=4"});
  clay.boundaries[0].kind = BoundaryKind::roller;
  clay.soils[0].strength.undrained_strength = 4e3;
  return clay;
}

/// The same stiffness without drainage, for total stresses: G is the clay's, and K 17 times as large.
Case of_total_stress(Case clay) {
  constexpr double ratio = 0.49;
  SoilCase& soil = clay.soils[0];
  soil.youngs_modulus *= (1 + ratio) / (1 + soil.poissons_ratio), soil.poissons_ratio = ratio;
  clay.water.mode = WaterMode::still;
  clay.water.coupling.motion = WaterMotion::quasi_static;
  return clay;
}

Measurement slump(const char* reference, const char* quantity, const Settings& settings) {
  return {.name = "failure/clay_slump",
          .settings = settings,
          .quantity = quantity,
          .reference = reference,
          .resolution = metres(0.25)};
}

void check_balances(const Deposit& d) {
  CAPTURE(d.energy.water / d.energy.released, d.energy.unaccounted / d.energy.released, d.drained,
          d.imbalance, d.misfit);
  CHECK(std::abs(d.energy.unaccounted) < 0.012 * d.energy.released);
  CHECK(d.energy.water > 0);
  CHECK(d.energy.water < 0.004 * d.energy.released);
  CHECK(std::abs(d.drained) < 1e-4 * 16);  // of its volume: what particles off the body give back
  CHECK(std::abs(d.imbalance) < 1e-9);
  CHECK(d.misfit < 1e-4);
}

}  // namespace

TEST_CASE("clay that keeps its water slumps as far as in total stresses, whatever the water's stiffness",
          "[water][dynamic][collapse]") {
  const Case clay = on_smooth_base();
  const Deposit total = deposit(of_total_stress(clay)), stiff = deposit(clay);
  check_balances(stiff);
  CHECK(stiff.displacement > 6);
  const auto of_total = [](const char* quantity) {
    return slump("the same clay in total stress, nu 0.49", quantity,
                 {"boundary.0.kind=roller", "soil.0.undrained_strength=4e3", "time.end=4"});
  };
  expect(of_total("95 % quantile of x, smooth base"), std::abs(stiff.quantile95 / total.quantile95 - 1),
         0.01);
  expect(of_total("mean of x, smooth base"), std::abs(stiff.mean / total.mean - 1), 0.01);
  for (const double bulk_modulus : {22e6, CouplingCase::incompressible}) {
    Case other = clay;
    other.water.coupling.bulk_modulus = bulk_modulus;
    const Deposit d = deposit(other);
    check_balances(d);
    CHECK(d.quantile95 == Approx(stiff.quantile95).epsilon(0.003));
    CHECK(d.mean == Approx(stiff.mean).epsilon(0.003));
  }
}

TEST_CASE("clay that keeps its water slumps on a rough base and comes to rest",
          "[water][dynamic][collapse]") {
  const Deposit d = deposit(scene("failure/clay_slump"));
  check_balances(d);
  CHECK(d.energy.kinetic < 1e-4 * d.energy.released);
  CHECK(d.energy.plastic > 0.8 * d.energy.released);
  const Deposit fine = deposit(scene("failure/clay_slump", {"particles.spacing=0.167"}));
  check_balances(fine);
  const auto of_spacing = [](const char* quantity) { return slump("spacing 0.167 m", quantity, {}); };
  expect(of_spacing("95 % quantile of x, rough base"), std::abs(fine.quantile95 / d.quantile95 - 1), 0.02);
  expect(of_spacing("mean of x, rough base"), std::abs(fine.mean / d.mean - 1), 0.03);
  expect(slump("conservation", "energy that is unaccounted for, over that released", {}),
         std::abs(d.energy.unaccounted / d.energy.released), 0.012);
}

TEST_CASE("a bank that is free on both sides slumps evenly", "[water][dynamic][collapse]") {
  Case clay = scene("failure/clay_slump", {"time.end=0.75"});
  clay.soils[0].polygon = {{-4, 0}, {4, 0}, {4, 4}, {-4, 4}};
  clay.boundaries = {{BoundaryKind::fixed, {-20, 0}, {20, 0}}};
  Simulation s(clay);
  run_to_end(s);
  const Particles& p = s.model().particles;
  CHECK(s.largest_displacement() > 0.7);
  double largest = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    std::size_t partner = 0;
    while (std::abs(p.start[partner].x() + p.start[a].x()) > 1e-9 ||
           std::abs(p.start[partner].y() - p.start[a].y()) > 1e-9)
      ++partner;
    largest = std::max({largest, std::abs(p.position[partner].x() + p.position[a].x()),
                        std::abs(p.position[partner].y() - p.position[a].y())});
  }
  CHECK(largest < 1e-4 * s.model().spacing);  // round-off grows as particles meet others
}
