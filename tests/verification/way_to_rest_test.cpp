// Elastic soils of very different stiffness come to the same rest, in as many steps as soils of one modulus.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// A soft layer of 8 MPa between soils of `contrast` times that, and half of it on top.
Simulation layered_embankment(const std::string& arrangement, double contrast, bool scaled = true) {
  Settings settings = {"particles.arrangement=" + arrangement,
                       "particles.spacing=0.5",
                       fmt::format("soil.gravel.youngs_modulus={}", 8e6 * contrast),
                       fmt::format("soil.fill.youngs_modulus={}", 8e6 * std::max(1.0, contrast / 2)),
                       "loading.damping=adaptive",
                       "time.end=1000",
                       "stop.unbalanced_force_ratio=1e-6"};
  if (arrangement == "disordered") settings.push_back("particles.disorder=0.1");
  if (!scaled) settings.push_back("loading.scaled_inertia=false");
  Simulation simulation(scene("embankment_layered", settings));
  run_to_end(simulation);
  return simulation;
}

/// Largest difference of what `value` reads of the particles, over the largest value.
template <class Value>
double difference(const Simulation& a, const Simulation& b, Value&& value) {
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.model().particles.size(); ++i) {
    const auto of_a = value(a.model().particles, i), of_b = value(b.model().particles, i);
    difference = std::max(difference, (of_a - of_b).norm()), largest = std::max(largest, of_b.norm());
  }
  return difference / largest;
}

}  // namespace

TEST_CASE("scaled inertia leads to the same rest", "[rest]") {
  const std::string arrangement = GENERATE("fitted", "disordered");
  const double contrast = GENERATE(10.0, 100.0);
  CAPTURE(arrangement, contrast);
  const Simulation scaled = layered_embankment(arrangement, contrast),
                   plain = layered_embankment(arrangement, contrast, false);
  REQUIRE(scaled.inertia().acts());
  REQUIRE_FALSE(plain.inertia().acts());
  CHECK(difference(scaled, plain, [](const Particles& p, std::size_t i) { return p.displacement(i); }) <
        1e-4);
  CHECK(difference(scaled, plain, [](const Particles& p, std::size_t i) {
          return Eigen::Vector4d(p.stress[i].xx, p.stress[i].yy, p.stress[i].zz, p.stress[i].xy);
        }) < 1e-4);
}

TEST_CASE("contrast costs no steps to rest", "[rest]") {
  const std::string arrangement = GENERATE("fitted", "disordered");
  CAPTURE(arrangement);
  const auto of_one_modulus = layered_embankment(arrangement, 1).step();
  for (const double contrast : {10.0, 100.0, 1e4}) {
    CAPTURE(contrast);
    CHECK(static_cast<double>(layered_embankment(arrangement, contrast).step()) <
          1.5 * static_cast<double>(of_one_modulus));
  }
}
