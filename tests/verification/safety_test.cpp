// A slope beside a lake that is drawn down slowly, against limit equilibrium.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/reference/limit_equilibrium/search.hpp"
#include "solver/reference/limit_equilibrium/section_of_case.hpp"
#include "solver/run/strength_reduction.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

TEST_CASE("drawdown lowers a slope's factor of safety to 1.3, and then raises it", "[safety]") {
  double lowest = never;
  for (const double level : {12, 6, 3, 0}) {
    const Settings settings = {fmt::format("water.level={:g}", level)};
    const Case slope = scene("safety/drawdown", settings);
    const auto surfaces = limit_equilibrium::find_critical_surfaces(limit_equilibrium::section_of(slope));
    REQUIRE(surfaces);
    REQUIRE(surfaces->spencer);
    const double exact = surfaces->spencer->factor;
    const StrengthReduction found = reduce_strength(slope, {.first_guess = exact, .jobs = 2});
    const double factor = (found.stable_at + found.fails_at) / 2;
    CAPTURE(level, found.stable_at, found.fails_at, exact);
    expect({.name = "safety/drawdown",
            .settings = settings,
            .quantity = fmt::format("factor of safety, water at {:g} m of 10: {:.2f}", level, factor),
            .reference = fmt::format("Spencer on circles: {:.2f}", exact),
            .resolution = metres(0.5),
            .subcommand = "safety"},
           std::abs(factor / exact - 1), 0.025);
    if (level > 0) CHECK(factor < lowest);
    if (level == 3) CHECK(factor == Approx(1.3).margin(0.03));  // Griffiths and Lane (1999)
    if (level == 0) CHECK(factor > lowest + 0.05);
    lowest = std::min(lowest, factor);
  }
}
