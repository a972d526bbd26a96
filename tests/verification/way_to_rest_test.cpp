// Elastic soils of very different stiffness come to the same rest, in as many steps as soils of one modulus.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>

#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

/// A soft layer of 800 MPa, which hardly strains, between soils of `contrast` times that, and half of it on
/// top.
Simulation layered_embankment(const std::string& arrangement, double contrast, bool scaled = true) {
  Settings settings = {"particles.arrangement=" + arrangement,
                       "particles.spacing=0.5",
                       "soil.clay.youngs_modulus=800e6",
                       fmt::format("soil.gravel.youngs_modulus={}", 800e6 * contrast),
                       fmt::format("soil.fill.youngs_modulus={}", 800e6 * std::max(1.0, contrast / 2)),
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

// To the strain, by which the stress of soil in large motion depends on its way: it is ten times as far with
// soil that strains ten times as much.
TEST_CASE("scaled inertia leads to the same rest", "[rest]") {
  const auto [arrangement, contrast] =
      GENERATE(table<std::string, double>({{"fitted", 100}, {"disordered", 10}}));
  CAPTURE(arrangement, contrast);
  const Simulation scaled = layered_embankment(arrangement, contrast),
                   plain = layered_embankment(arrangement, contrast, false);
  REQUIRE(scaled.inertia().acts());
  REQUIRE_FALSE(plain.inertia().acts());
  CHECK(difference(scaled, plain, [](const Particles& p, std::size_t i) { return p.displacement(i); }) <
        2e-5);
  CHECK(difference(scaled, plain, [](const Particles& p, std::size_t i) {
          return Eigen::Vector4d(p.stress[i].xx, p.stress[i].yy, p.stress[i].zz, p.stress[i].xy);
        }) < 2e-5);
}

TEST_CASE("contrast costs few steps to rest", "[rest]") {
  const auto steps = [&](const std::string& arrangement, double contrast) {
    return static_cast<double>(layered_embankment(arrangement, contrast).step());
  };
  const double of_one_modulus = steps("fitted", 1);
  CHECK(steps("fitted", 10) < of_one_modulus);
  CHECK(steps("fitted", 100) < 1.5 * of_one_modulus);
  CHECK(steps("disordered", 100) < 1.5 * of_one_modulus);
  CHECK(steps("fitted", 1e3) < 1.8 * of_one_modulus);
  CHECK(steps("fitted", 1e4) < 4 * of_one_modulus);
}
