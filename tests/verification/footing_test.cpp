// Bearing capacity of strip footings on frictional soil: Prandtl and Reissner's N_q, and N_gamma by slip
// lines.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/case/stages.hpp"
#include "tests/verification/slip_lines.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double surcharge = 10e3, weight = 20e3;  // [Pa], [N/m3]; half of the footing is 1 m wide

/// exp(pi tan(phi)) tan(45 + phi/2)^2
double n_q(double friction_degrees) {
  const double phi = friction_degrees * std::numbers::pi / 180;
  return std::exp(std::numbers::pi * std::tan(phi)) * std::pow(std::tan(std::numbers::pi / 4 + phi / 2), 2);
}

Settings sand(double friction, double dilation, double settlement, double spacing) {
  return {fmt::format("soil.0.friction_angle={:g}", friction),
          fmt::format("soil.0.dilation_angle={:g}", dilation),
          fmt::format("footing.0.settlement={:g}", settlement),
          fmt::format("particles.spacing={:g}", spacing)};
}

/// Mean pressure under the footing over the surcharge, while it is pressed into the ground.
double measured_n_q(const Settings& settings) {
  StagePlan plan(scene("loads/footing_surcharge", settings));
  Simulation loaded(plan.scene());
  run_to_end(loaded);
  const HandedOver state = loaded.hand_over();
  const double begun = loaded.time();
  REQUIRE(plan.go_on(begun).empty());
  Simulation pressed(plan.scene(), Beginning{.time = begun, .state = &state});
  const double force = mean_force_on_footing(pressed, begun);
  return (force + surcharge) / surcharge;  // the surcharge presses under the footing as well
}

double measured_n_gamma(const Settings& settings) {
  Simulation pressed(scene("loads/footing_weight", settings));
  return mean_force_on_footing(pressed, 0) / weight;
}

/// Davis 1968: along bands that do not dilate soil bears sin(phi) of the normal stress.
double without_dilation(double friction_degrees) {
  const double degree = std::numbers::pi / 180;
  return std::atan(std::sin(friction_degrees * degree)) / degree;
}

}  // namespace

TEST_CASE("slip lines have Martin's bearing capacity factors", "[footing]") {
  CHECK(SlipLines(20, false).n_gamma() == Approx(1.579).epsilon(1e-3));
  CHECK(SlipLines(20, true).n_gamma() == Approx(2.839).epsilon(1e-3));
  CHECK(SlipLines(30, false).n_gamma() == Approx(7.653).epsilon(1e-3));
  CHECK(SlipLines(30, true).n_gamma() == Approx(14.754).epsilon(1e-3));
}

TEST_CASE("a rough footing on clay bears 2 + pi times its strength", "[footing]") {
  const double spacing = GENERATE(0.2, 0.1);
  const Settings settings = {fmt::format("particles.spacing={:g}", spacing)};
  Simulation pressed(scene("loads/bearing_capacity", settings));
  run_to_end(pressed);
  const double factor = pressed.footings()[0].force() / 10e3;  // of half the footing, 1 m wide
  expect({.name = "loads/bearing_capacity",
          .settings = settings,
          .quantity = fmt::format("load over the undrained strength: {:.3f}", factor),
          .reference = "Prandtl: 5.142",
          .resolution = metres(spacing)},
         std::abs(factor / (2 + std::numbers::pi) - 1), spacing < 0.15 ? 0.02 : 0.03);
}

// 0.1 m takes five times as long: docs/theory.md has its result.
TEST_CASE("a footing on clay that keeps its water sinks at 2 + pi times its undrained strength",
          "[footing]") {
  const Settings settings = {"particles.spacing=0.2"};
  const Case clay = scene("failure/footing_on_soft_clay", settings);
  Simulation loaded(clay);
  double at_rest = 0;
  RunWatch watch;
  watch.progress = [&](const Simulation& now) {
    if (!now.in_motion()) at_rest = now.footings()[0].settlement(now.model().particles);
  };
  run_to_end(loaded, watch);
  REQUIRE(loaded.in_motion());
  CHECK(loaded.footings()[0].settlement(loaded.model().particles) > 1.3 * at_rest);
  const double load = loaded.failed_at() / clay.time.end * clay.footings[0].force;  // of half of it, 1 m wide
  const double factor = load / 10e3;
  expect({.name = "failure/footing_on_soft_clay",
          .settings = settings,
          .quantity = fmt::format("load over c cos(phi) where equilibrium is lost: {:.3f}", factor),
          .reference = "Prandtl: 5.142",
          .resolution = metres(0.2)},
         std::abs(factor / (2 + std::numbers::pi) - 1), 0.01);
}

TEST_CASE("a footing on weightless sand bears the surcharge times N_q", "[footing]") {
  const auto [friction, settlement] = GENERATE(table<double, double>({{20, 0.0003}, {30, 0.0008}}));
  const double spacing = GENERATE(from_range(coarse_and_fine(0.2, 0.1)));
  const Settings settings = sand(friction, friction, settlement, spacing);
  const double factor = measured_n_q(settings), exact = n_q(friction);
  CAPTURE(friction, spacing, factor, exact);
  expect({.name = "loads/footing_surcharge",
          .settings = settings,
          .quantity = fmt::format("N_q at a friction angle of {:g} degrees: {:.3g}", friction, factor),
          .reference = fmt::format("Prandtl and Reissner: {:.4g}", exact),
          .resolution = metres(spacing)},
         std::abs(factor / exact - 1), spacing < 0.15 ? 0.03 : 0.08);
}

TEST_CASE("a footing on heavy sand bears its weight times N_gamma", "[footing]") {
  const auto [friction, settlement] = GENERATE(table<double, double>({{20, 0.0003}, {30, 0.0012}}));
  const double spacing = GENERATE(from_range(coarse_and_fine(0.2, 0.1)));
  const Settings settings = sand(friction, friction, settlement, spacing);
  const double factor = measured_n_gamma(settings), exact = SlipLines(friction, true).n_gamma();
  CAPTURE(friction, spacing, factor, exact);
  expect({.name = "loads/footing_weight",
          .settings = settings,
          .quantity = fmt::format("N_gamma of a rough footing at {:g} degrees: {:.3g}", friction, factor),
          .reference = fmt::format("slip lines: {:.4g}", exact),
          .resolution = metres(spacing)},
         std::abs(factor / exact - 1), spacing < 0.15 ? 0.05 : 0.14);
}

TEST_CASE("without dilation sand bears less than the exact factors", "[footing]") {
  const Settings settings = sand(30, 0, 0.0008, 0.2);
  const double factor = measured_n_q(settings), weaker = without_dilation(30);
  CAPTURE(factor, n_q(weaker), n_q(30));
  CHECK(factor > n_q(weaker));
  CHECK(factor < n_q(30));
}
