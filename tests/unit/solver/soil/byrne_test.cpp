// Byrne's sand in undrained cyclic simple shear, against the sum over half-cycles of its equation.
#include "solver/soil/byrne.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/element/element_test.hpp"

using namespace porosph;

namespace {

constexpr double p0 = 100e3, c1 = 0.8, c2 = 0.5;
const Elasticity elastic = Elasticity::from_young(30e6, 0.3);

Byrne sand(double friction) { return {MohrCoulomb::from_angles(elastic, 0, friction), c1, c2, 1e-4}; }

/// Strain to and fro between gamma and -gamma, `cycles` times.
ElementPath sheared(const Byrne& law, double gamma, int cycles, int steps) {
  ElementSetup setup{.test = ElementTest::simple_shear_undrained,
                     .axial_stress = p0,
                     .radial_stress = p0,
                     .targets = {},
                     .steps = steps};
  for (int i = 0; i < cycles; ++i) setup.targets.insert(setup.targets.end(), {gamma, -gamma});
  return run_element_test(law, setup);
}

/// e_vd after so many half-cycles, the first of which begins at rest.
double compaction_after(int half_cycles, double gamma) {
  double e = 0;
  for (int i = 0; i < half_cycles; ++i) {
    const double amplitude = i == 0 ? gamma / 2 : gamma;
    e += 0.5 * c1 * amplitude * std::exp(-c2 * e / amplitude);
  }
  return e;
}

}  // namespace

TEST_CASE("cycles of shear put Byrne's sand under pore pressure as his equation says", "[soil][byrne]") {
  constexpr double gamma = 2e-3;
  constexpr int cycles = 6, steps = 100;
  const ElementPath path = sheared(sand(35), gamma, cycles, steps);
  // Half-cycles are counted once the strain has come back by twice the threshold: by a fifth of the way.
  for (int half = 1; half < 2 * cycles; ++half) {
    const ElementState& s = path.states[static_cast<std::size_t>(half * steps + steps / 2)];
    const double e = compaction_after(half, gamma), u = std::min(elastic.bulk_modulus * e, p0);
    CHECK(s.history[3] == Approx(e).epsilon(1e-9));
    CHECK(s.mean_pressure() == Approx(p0 - u).margin(1e-6 * p0));
    if (u < p0) CHECK(s.pore_pressure == Approx(u).epsilon(0.02));  // where it yields, sigma'_yy leaves p'
  }
  CHECK(compaction_after(2 * cycles - 1, gamma) * elastic.bulk_modulus > p0);  // it has liquefied
  CHECK(path.states.back().pore_pressure == Approx(p0).epsilon(1e-9));
}

TEST_CASE("Byrne's sand stays within its strength, and bears no shear once it has liquefied",
          "[soil][byrne]") {
  const Byrne law = sand(30);
  const ElementPath path = sheared(law, 4e-3, 8, 200);
  for (const ElementState& s : path.states) {
    REQUIRE(s.largest_shear_stress() <= std::sin(M_PI / 6) * s.largest_mean() + 1e-6 * p0);
    REQUIRE(s.mean_pressure() >= -1e-6 * p0);
  }
  CHECK(path.states.back().largest_shear_stress() < 1e-6 * p0);
}

TEST_CASE("strain that goes one way, or to and fro within the threshold, compacts no sand", "[soil][byrne]") {
  CHECK(sheared(sand(35), 0.9e-4, 20, 20).states.back().history[3] == 0);
  ElementSetup one_way{.test = ElementTest::simple_shear_undrained,
                       .axial_stress = p0,
                       .radial_stress = p0,
                       .targets = {0.02},
                       .steps = 50};
  CHECK(run_element_test(sand(35), one_way).states.back().history[3] == 0);
}

TEST_CASE("small strain to and fro on the way of a large half-cycle does not end it", "[soil][byrne]") {
  const Byrne law = sand(35);
  Byrne::History smooth, ragged;
  for (int i = 0; i <= 400; ++i) {
    const double shear = 1e-3 * std::sin(i * 2 * M_PI / 100);
    law.compact(smooth, shear);
    law.compact(ragged, shear + (i % 2 ? 0.5e-4 : -0.5e-4));
  }
  CHECK(smooth.compaction > 0);
  CHECK(ragged.compaction == Approx(smooth.compaction).epsilon(0.06));  // amplitudes are 5 % larger
}
