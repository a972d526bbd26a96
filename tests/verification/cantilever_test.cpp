// Bending: the oscillating plate of Gray, Monaghan and Swift (2001).
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/exact/cantilever.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// Time from the first to the third passage through zero.
double period_of(const std::vector<std::vector<double>>& rows, std::size_t column) {
  std::vector<double> passages;
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const double before = rows[i - 1][column], after = rows[i][column];
    if (before * after < 0)
      passages.push_back(rows[i - 1][0] + (rows[i][0] - rows[i - 1][0]) * before / (before - after));
  }
  REQUIRE(passages.size() >= 2);
  return 2 * (passages[1] - passages[0]);
}

}  // namespace

TEST_CASE("cantilever: the plate swings with the period of its first mode") {
  Simulation s(scene("cantilever"));
  const Cantilever plate{.length = 0.2, .thickness = 0.02, .youngs_modulus = 2e6, .poissons_ratio = 0.3975,
                         .density = s.model().particles.density[0]};
  const double exact = 2 * M_PI / thick_plate_frequency(plate);
  std::vector<std::vector<double>> rows;
  run_to_end(s, {.history = [&](const std::vector<double>& row) { rows.push_back(row); }});
  REQUIRE(history_columns(s).back() == "tip.Displacement_Y");
  const std::size_t tip = rows[0].size() - 1;
  double highest = 0;
  for (const auto& row : rows) highest = std::max(highest, row[tip]);
  const double amplitude = 0.05 * thick_plate_shape(plate, 0.199).deflection * exact / (2 * M_PI);
  expect({"cantilever", {}, "period of the plate, consistent form", "Timoshenko's plate", "10 particles over the thickness"},
         std::abs(period_of(rows, tip) / exact - 1), 0.03);
  expect({"cantilever", {}, "first amplitude of its tip, consistent form", "Timoshenko's plate",
          "10 particles over the thickness"},
         std::abs(highest / amplitude - 1), 0.05);
}
