// Two dry soils of a density ratio below 0.5: section III.A of the paper says that eq. (14) may fail there, which divides
// each stress by its own density squared.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

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

TEST_CASE("layers: measure") {
  for (const char* motion : {"consistent", "proposed", "rho_squared"})
    for (const Settings& weights :
         {Settings{}, Settings{"soil.lower.unit_weight_saturated=8e3", "soil.upper.unit_weight_saturated=20e3"},
          Settings{"soil.upper.unit_weight_saturated=4e3"}, Settings{"soil.upper.unit_weight_saturated=12e3"}, Settings{"soil.upper.unit_weight_saturated=20e3"}}) {
      Settings settings = weights;
      settings.push_back(std::string("formulation.motion=") + motion);
      const Errors e = stress_errors(settings);
      WARN(motion << " " << (weights.empty() ? "" : weights[0]) << ": " << e.everywhere << " interface " << e.at_interface);
    }
}
