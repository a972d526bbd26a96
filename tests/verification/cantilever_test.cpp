// Bending: the oscillating plate of Gray, Monaghan and Swift (2001).
#include "solver/reference/exact/cantilever.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// Twice the time that the tip is up first.
double period_of(const std::vector<std::vector<double>>& rows, std::size_t column) {
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const double before = rows[i - 1][column], after = rows[i][column];
    if (before > 0 && after <= 0)
      return 2 * (rows[i - 1][0] + (rows[i][0] - rows[i - 1][0]) * before / (before - after));
  }
  FAIL("the tip did not come back");
  return 0;
}

struct Errors {
  double period = 0, amplitude = 0;  ///< relative
};

Errors plate_errors(const Settings& settings) {
  Simulation s(scene("cantilever", settings));
  const Cantilever plate{.length = 0.2,
                         .thickness = 0.02,
                         .youngs_modulus = 2e6,
                         .poissons_ratio = 0.3975,
                         .density = s.model().particles.density[0]};
  const double exact = 2 * M_PI / thick_plate_frequency(plate);
  std::vector<std::vector<double>> rows;
  RunWatch watch;
  watch.history = [&](const std::vector<double>& row) { rows.push_back(row); };
  run_to_end(s, watch);
  REQUIRE(history_columns(s).back() == "tip.Displacement_Y");
  const std::size_t tip = rows[0].size() - 1;
  double highest = 0;
  for (const auto& row : rows) highest = std::max(highest, row[tip]);
  const double amplitude =
      0.05 * thick_plate_shape(plate, s.probes()[0].start().x()).deflection * exact / (2 * M_PI);
  return {std::abs(period_of(rows, tip) / exact - 1), std::abs(highest / amplitude - 1)};
}

Settings rows_over_thickness(int count) {
  return {fmt::format("particles.spacing={:.7g}", 0.02 / count), "time.end=0.15"};
}

void expect_period(const Settings& settings, int count, double error, double limit,
                   const std::string& order = {}) {
  expect({"cantilever", settings, "period of the plate, consistent form", "Timoshenko's plate",
          fmt::format("{} particles over the thickness", count), order},
         error, limit);
}

}  // namespace

// Half of the error comes from the rows at the free faces, where a gradient that is exact for linear fields
// takes the bending strain at a height too small; it falls with the square of the spacing.
TEST_CASE("cantilever: the period converges with second order") {
  const std::vector<int> counts = {5, 8, 10};
  const std::vector<double> limits = {0.15, 0.056, 0.035};
  std::vector<double> spacings, errors;
  for (int count : counts) {
    spacings.push_back(0.02 / count);
    errors.push_back(plate_errors(rows_over_thickness(count)).period);
  }
  const double order = fitted_order(spacings, errors);
  for (std::size_t i = 0; i < counts.size(); ++i)
    expect_period(rows_over_thickness(counts[i]), counts[i], errors[i], limits[i],
                  fmt::format("{:.2f}", order));
  INFO("order " << order);
  CHECK(order > 1.6);
}

TEST_CASE("cantilever: a smaller smoothing length comes within 3 per cent") {
  const Settings settings = {"particles.smoothing_ratio=1", "time.end=0.15"};
  const Errors errors = plate_errors(settings);
  expect_period(settings, 10, errors.period, 0.03);
  expect({"cantilever", settings, "first amplitude of the tip, consistent form", "Timoshenko's plate",
          "10 particles over the thickness"},
         errors.amplitude, 0.05);
}

TEST_CASE("cantilever: particles on the faces make the period thirty times as exact") {
  for (const auto& [count, limit] : {std::pair{5, 0.005}, std::pair{10, 0.002}}) {
    Settings settings = rows_over_thickness(count);
    settings.insert(settings.end(), {"particles.smoothing_ratio=1", "particles.arrangement=surface",
                                     "formulation.zero_energy_control=0.05"});
    expect_period(settings, count, plate_errors(settings).period, limit);
  }
}
