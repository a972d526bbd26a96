// From the keys of a soil to its law, and strength that is reduced.
#include "solver/model/soil_law.hpp"

#include <catch2/catch.hpp>

#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

SoilCase weak(LawKind law) {
  SoilCase soil = box_of_soil(4, 4).soils[0];
  soil.law = law;
  soil.strength.cohesion = 6e3, soil.strength.friction_angle = 30, soil.strength.dilation_angle = 20,
  soil.strength.dilation_limit = 0.05;
  soil.strength.undrained_strength = 25e3, soil.strength.growth = 2e3;
  return soil;
}

constexpr double radian = std::numbers::pi / 180;

}  // namespace

TEST_CASE("strength is reduced as c and tan phi, or c_u", "[law]") {
  const double f = GENERATE(1.0, 1.7);
  const double phi = std::atan(std::tan(30 * radian) / f);
  const auto mc = std::get<MohrCoulomb>(soil_law(weak(LawKind::mohr_coulomb), 0.5, f));
  CHECK(mc.sin_phi == Approx(std::sin(phi)).epsilon(1e-14));
  CHECK(mc.c_cos_phi == Approx(6e3 / f * std::cos(phi)).epsilon(1e-14));
  CHECK(mc.dilation_limit == 0.05);
  CHECK(mc.sin_psi == Approx(std::sin(std::min(20 * radian, phi))).epsilon(1e-14));
  const auto dp = std::get<DruckerPrager>(soil_law(weak(LawKind::drucker_prager), 0.5, f));
  CHECK(dp.sin_phi == Approx(std::sin(phi)).epsilon(1e-14));
  const auto clay = std::get<Tresca>(soil_law(weak(LawKind::tresca), 0.5, f));
  const Tresca::History q = clay.at_start(Vec2(0, 1.5));
  CHECK(clay.undrained_strength(q) == Approx((25e3 + 2e3 * 0.5) / f).epsilon(1e-14));
}

TEST_CASE("softening counts plastic strain by spacing over length", "[law]") {
  SoilCase soil = weak(LawKind::mohr_coulomb);
  soil.strength.softening = SofteningKind::linear;
  soil.strength.softening_strain = 0.3, soil.strength.softening_length = 2;
  const auto law = std::get<MohrCoulomb>(soil_law(soil, 0.5));
  // A band of a quarter of the length shears four times as far for the same slip.
  CHECK(law.softening.left(0.6 / std::numbers::sqrt3) == Approx(1 - 0.6 / 0.3 / 4));
}

TEST_CASE("clay keeps the strength of where it was at the start, also when it is reduced", "[law]") {
  Case scene = box_of_soil(4, 8, 0.25);
  hold_as_column(scene);
  scene.soils[0] = weak(LawKind::tresca);
  scene.soils[0].polygon = box_outline(0, 0, 1, 2);
  const Point away = GENERATE(Point(0, 0), Point(3e5, 2e4));
  scene.soils[0].strength.level = GENERATE(never, 0.5);
  const double level = std::min(scene.soils[0].strength.level, 2.0);
  for (Point& p : scene.soils[0].polygon) p += away;
  for (BoundaryCase& b : scene.boundaries) b.from += away, b.to += away;
  scene.soils[0].strength.level += away.y();
  Simulation simulation(scene);
  const auto check = [&] {
    const Particles& p = simulation.model().particles;
    const HistoryField& strength = p.history[1];
    REQUIRE(strength.field.name == "UndrainedStrength");
    for (std::size_t a = 0; a < p.size(); ++a) {
      const double y = p.start[a].y() + simulation.model().origin.y() - away.y();
      CHECK(strength.values[a] == Approx(25e3 + 2e3 * std::max(0.0, level - y)).epsilon(1e-12));
    }
  };
  check();
  for (int k = 0; k < 20; ++k) simulation.advance();
  simulation.reduce_strength(1.4);
  simulation.advance();
  check();
  CHECK(std::get<Tresca>(simulation.model().soils[0].law()).reduction == Approx(1 / 1.4));
}

TEST_CASE("a running simulation yields at the strength that it has been reduced to", "[law]") {
  Case scene = box_of_soil(6, 8, 0.25);
  hold_as_column(scene);
  scene.soils[0].law = GENERATE(LawKind::mohr_coulomb, LawKind::drucker_prager, LawKind::tresca);
  scene.soils[0].strength.cohesion = 4e3, scene.soils[0].strength.friction_angle = 25;
  scene.soils[0].strength.undrained_strength = 7e3;
  Simulation simulation(scene);
  const auto largest = [&] {
    double most = 0;
    const Particles& p = simulation.model().particles;
    for (std::size_t a = 0; a < p.size(); ++a)
      most = std::max(most, simulation.model().soils[0].mobilised_strength(p, a));
    return most;
  };
  for (int k = 0; k < 300; ++k) simulation.advance();
  const double before = largest();
  CHECK(before < 0.99);
  CHECK(before > 0.2);
  simulation.reduce_strength(before > 0.5 ? 3 : 6);
  for (int k = 0; k < 5; ++k) simulation.advance();
  CHECK(largest() == 1);
}
