// The shipped columns against the laws that experiments gave.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

struct Deposit {
  double quantile95, mean;  ///< of x [m]
  double height;            ///< of the soil at the wall [m]
  double kinetic;           ///< over the energy that the fall has set free
};

Deposit deposit_of(const std::string& name) {
  Simulation simulation(scene(name));
  const double before = simulation.energy().gravity;
  run_to_end(simulation);
  const Simulation::Energy energy = simulation.energy();
  const Particles& p = simulation.model().particles;
  std::vector<double> x;
  double mean = 0, height = 0;
  const double spacing = simulation.model().spacing;
  for (const Vec2& at : p.position) {
    x.push_back(at.x()), mean += at.x() / static_cast<double>(p.size());
    CHECK(at.y() > 0);
    if (at.x() < 2 * spacing) height = std::max(height, at.y() + 0.5 * spacing);
  }
  std::ranges::sort(x);
  return {x[x.size() * 95 / 100], mean, height, energy.kinetic / (before - energy.gravity)};
}

double spacing_of(const std::string& name) { return scene(name).particles.spacing; }

/// What experiments say of a column of width 1: how far its front comes (Lube et al. 2005, Lajeunesse et al.
/// 2005), how high it stays at the wall (Lajeunesse et al. 2005), and with both the profile height (1 - x /
/// front)^n that has the column's area.
struct Law {
  double front, height, power;
  explicit Law(double aspect)
      : front(1 + (aspect < 2 ? 1.2 * aspect : 1.9 * std::pow(aspect, 2.0 / 3))),
        height(aspect < 0.7 ? aspect : std::cbrt(aspect)),
        power(height * front / aspect - 1) {}
  double quantile(double part) const { return front * (1 - std::pow(1 - part, 1 / (power + 1))); }
  double mean() const { return front / (power + 2); }
};

}  // namespace

TEST_CASE("slides and cuts that ship run to their end above their base", "[failure]") {
  const std::string name = GENERATE("failure/vertical_cut", "failure/dry_slide", "failure/submerged_slide");
  const double courant = GENERATE(0.3, 0.6, 0.8);
  CAPTURE(name, courant);
  Case failing = scene(name);
  failing.time.courant = courant;
  Simulation simulation(failing);
  run_to_end(simulation);
  double lowest = never;
  for (const Vec2& at : simulation.model().particles.position) lowest = std::min(lowest, at.y());
  CHECK(lowest > 0);
}

// Clay whose strength falls from 52 to 20 kPa in bands of half a metre.
TEST_CASE("how far a softening cut comes does not depend on the spacing", "[failure]") {
  const auto settings = [](double spacing) {
    return Settings{fmt::format("particles.spacing={:g}", spacing),
                    "time.end=2",
                    "soil.clay.undrained_strength=52e3",
                    "soil.clay.sensitivity=2.6",
                    "soil.clay.softening=exponential",
                    "soil.clay.softening_strain=0.125",
                    "soil.clay.softening_length=0.5"};
  };
  const auto mean_way = [&](double spacing) {
    Simulation simulation(scene("failure/vertical_cut", settings(spacing)));
    run_to_end(simulation);
    const Particles& p = simulation.model().particles;
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.displacement(i).norm();
    return sum / static_cast<double>(p.size());
  };
  const double usual = mean_way(0.5);
  CHECK(usual > 1);
  for (const double spacing : {1.0, 0.25})
    expect({.name = "failure/vertical_cut",
            .settings = settings(spacing),
            .quantity = "mean way of softening clay in 2 s, difference",
            .reference = "the same at 0.5 m",
            .resolution = metres(spacing)},
           std::abs(mean_way(spacing) / usual - 1), 0.2);
}

TEST_CASE("soil slides under water in the paper's forms as well, along walls beyond where it lay",
          "[failure]") {
  const Motion motion = GENERATE(Motion::proposed, Motion::rho_squared);
  const double courant = GENERATE(0.3, 0.6);
  CAPTURE(motion_name(motion), courant);
  Case sliding = scene("failure/submerged_slide");
  sliding.formulation = default_formulation(motion);
  sliding.time.courant = courant;
  Simulation simulation(sliding);
  run_to_end(simulation);
  double lowest = never, farthest = 0;
  for (const Vec2& at : simulation.model().particles.position)
    lowest = std::min(lowest, at.y()), farthest = std::max(farthest, at.x());
  CHECK(lowest > -0.05);  // walls stop the velocity, not what they have let through
  CHECK(farthest > 33);   // it began at 30 m
  CHECK(farthest < 45);
}

// The friction angle of these cases was chosen by what such columns do: see the cases.
TEST_CASE("columns of sand go about as far as in experiments", "[collapse]") {
  constexpr double width = 0.1;
  const auto [name, aspect] = GENERATE(
      table<const char*, double>({{"collapse/wide", 0.5}, {"collapse/square", 1}, {"collapse/tall", 2}}));
  const Deposit d = deposit_of(name);
  const Law law(aspect);
  const auto compare = [&](const std::string& quantity, double value, double expected, double allowed) {
    CAPTURE(name, quantity, value, expected);
    expect({.name = name,
            .settings = {},
            .quantity = quantity,
            .reference = "deposit of the experiments' laws",
            .resolution = metres(spacing_of(name))},
           std::abs(value / expected - 1), allowed);
  };
  compare("95 % quantile of x", d.quantile95 / width, law.quantile(0.95), 0.15);
  compare("mean of x", d.mean / width, law.mean(), 0.15);
  compare("height left at the wall", d.height / width, law.height, 0.2);
  CHECK(d.kinetic < 1e-4);
}

TEST_CASE("a column of sand that dilates comes to rest, no looser than its limit", "[collapse]") {
  const int angle = GENERATE(5, 15, 30);
  const std::string law = GENERATE("drucker_prager", "mohr_coulomb");
  CAPTURE(angle, law);
  Simulation simulation(
      scene("collapse/square", {"particles.spacing=0.005", "probe=[]", "soil.sand.law=" + law,
                                fmt::format("soil.sand.dilation_angle={}", angle)}));
  const double before = simulation.energy().gravity;
  const std::vector<double> density = simulation.model().particles.density;
  run_to_end(simulation);
  const Simulation::Energy energy = simulation.energy();
  CHECK(energy.kinetic < 1e-4 * (before - energy.gravity));
  const Particles& p = simulation.model().particles;
  double volume = 0, loosest = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    volume += density[a] / p.density[a] / static_cast<double>(p.size());
    loosest = std::max(loosest, density[a] / p.density[a]);
  }
  const double limit = std::exp(scene("collapse/square").soils[0].strength.dilation_limit);
  CHECK(volume > 1.03);
  CHECK(volume < limit);
  CHECK(loosest < 1.05 * limit);  // by what the last step before the limit adds
}
