// Two dry soils of a density ratio below 0.5: section III.A of the paper says that eq. (14) may fail there,
// which divides each stress by its own density squared.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

const Settings reversed = {"soil.lower.unit_weight_saturated=8e3", "soil.upper.unit_weight_saturated=20e3"};

Settings joined(Settings settings, const std::string& formulation) {
  settings.push_back("formulation." + formulation);
  return settings;
}

struct Errors {
  double everywhere = 0;    ///< relative L2
  double at_interface = 0;  ///< largest error within three spacings of it, over the stress there
};

/// Against the weight of what lies above, which without water is the exact stress at any strain.
Errors stress_errors(const Settings& settings) {
  Simulation s(scene("layers", settings));
  run_to_end(s);
  const auto& soils = s.scene().soils;
  const double below = soils[0].unit_weight_saturated, above = soils[1].unit_weight_saturated;
  const Particles& p = s.model().particles;
  double difference = 0, reference = 0;
  Errors errors;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double y = p.start[i].y();
    const double exact = -above * std::min(5.0, 10 - y) - below * std::max(0.0, 5 - y);
    const double error = p.stress[i].yy - exact;
    difference += error * error, reference += exact * exact;
    if (std::abs(y - 5) < 3 * s.model().spacing)
      errors.at_interface = std::max(errors.at_interface, std::abs(error) / (above * 5));
  }
  errors.everywhere = std::sqrt(difference / reference);
  return errors;
}

}  // namespace

TEST_CASE("layers: eq. (15) and the consistent form carry a density ratio of 0.4") {
  for (const std::string form : {"proposed", "consistent"})
    for (const Settings& weights : {Settings{}, reversed}) {
      const Settings settings = joined(weights, "motion=" + form);
      const Errors errors = stress_errors(settings);
      expect({"layers", settings, "vertical stress, density ratio 0.4, relative L2, " + form + " form",
              "weight above", metres(0.25)},
             errors.everywhere, 0.035);
      CHECK(errors.at_interface < 0.07);
    }
}

TEST_CASE("layers: eq. (14) carries a density ratio of 0.8") {
  const Settings settings = joined({"soil.upper.unit_weight_saturated=16e3"}, "motion=rho_squared");
  expect({"layers", settings, "vertical stress, density ratio 0.8, relative L2, eq. (14)", "weight above",
          metres(0.25)},
         stress_errors(settings).everywhere, 0.03);
}

// The paper's claim holds: 0.025 at 0.8, 0.05 at 0.6, 0.08 at just below 0.5, and then no solution at all.
TEST_CASE("layers: eq. (14) fails at density ratios below 0.5") {
  for (const Settings& weights : {Settings{}, reversed}) {
    const Settings settings = joined(weights, "motion=rho_squared");
    Simulation s(scene("layers", settings));
    CHECK(run(s, {}).status == RunStatus::unstable);
    note({"layers", settings, "vertical stress, density ratio 0.4, eq. (14)", "weight above", metres(0.25)},
         "unstable", "must fail");
  }
  const Settings lighter = joined({"soil.upper.unit_weight_saturated=4e3"}, "motion=rho_squared");
  Simulation s(scene("layers", lighter));
  CHECK(run(s, {}).status == RunStatus::unstable);
  note({"layers", lighter, "vertical stress, density ratio 0.2, eq. (14)", "weight above", metres(0.25)},
       "unstable", "must fail");
}
