#include "solver/water/flow/retention.hpp"

#include <catch2/catch.hpp>

using namespace porosph;

TEST_CASE("van Genuchten's and Mualem's curves go through published soils", "[water]") {
  // Carsel and Parrish 1988: sand, loam, clay.
  const auto [alpha, n, psi, se, kr] =
      GENERATE(table<double, double, double, double, double>({{14.5, 2.68, -0.1, 0.43985, 2.122e-2},
                                                              {14.5, 2.68, -1, 0.01119, 2.473e-8},
                                                              {3.6, 1.56, -0.1, 0.93576, 0.21544},
                                                              {3.6, 1.56, -1, 0.46628, 1.359e-3},
                                                              {0.8, 1.09, -0.1, 0.99491, 4.290e-2},
                                                              {0.8, 1.09, -1, 0.95332, 4.206e-3}}));
  const Retention soil({.model = RetentionModel::van_genuchten, .alpha = alpha, .n = n}, 0.1);
  CHECK(soil.saturation(psi) == Approx(se).epsilon(1e-3));
  CHECK(soil.permeability(psi).kr == Approx(kr).epsilon(1e-3));
}

TEST_CASE("the slope of kr is its derivative", "[water]") {
  const RetentionCase law =
      GENERATE(RetentionCase{.model = RetentionModel::van_genuchten, .alpha = 3.6, .n = 1.56},
               RetentionCase{.model = RetentionModel::gardner, .alpha = 2}, RetentionCase{},
               RetentionCase{.model = RetentionModel::table,
                             .saturation = {{0, 1}, {0.2, 0.8}, {1, 0.1}},
                             .permeability = {{0, 1}, {0.2, 0.3}, {1, 1e-4}}});
  const Retention soil(law, 0.5);
  for (const double psi : {-0.01, -0.1, -0.3, -2.0}) {
    constexpr double step = 1e-6;
    const double slope = (soil.permeability(psi + step).kr - soil.permeability(psi - step).kr) / (2 * step);
    CAPTURE(static_cast<int>(law.model), psi);
    CHECK(soil.permeability(psi).slope == Approx(slope).epsilon(1e-5));
    const double stored =
        (soil.stored(psi + step).saturation - soil.stored(psi - step).saturation) / (2 * step);
    CHECK(soil.stored(psi).slope == Approx(stored).epsilon(1e-5).margin(1e-12));
  }
  CHECK(soil.permeability(0).kr == 1);
  CHECK(soil.permeability(3).kr == 1);
  CHECK(soil.saturation(1) == 1);
}

TEST_CASE("kr is continuous and has a slope up to saturation", "[water]") {
  const double n = GENERATE(1.09, 1.56, 2.0, 2.68);
  const Retention soil({.model = RetentionModel::van_genuchten, .alpha = 2, .n = n}, 0.5);
  double before = 1;
  for (const double psi : {-1e-17, -1e-9, -4.999e-4, -5.001e-4, -1e-3}) {
    const Retention::Permeability p = soil.permeability(psi);
    CAPTURE(n, psi);
    CHECK(std::isfinite(p.slope));
    CHECK(p.slope >= 0);
    CHECK(p.kr <= before);
    before = p.kr;
  }
  CHECK(soil.permeability(-5.001e-4).kr == Approx(soil.permeability(-4.999e-4).kr).epsilon(1e-3));
}
