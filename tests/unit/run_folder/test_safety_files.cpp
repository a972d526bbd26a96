// What is said where particles and limit equilibrium disagree on a factor of safety.
#include <catch2/catch.hpp>

#include "vtk_io/run_folder/safety_files.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// Of particles that stand and fail at these factors, beside surfaces of which the least has a factor of 1.2.
SafetyAnswer answer_of(double stable_at, double fails_at) {
  SafetyAnswer answer;
  answer.particles.emplace();
  answer.particles->stable_at = stable_at, answer.particles->fails_at = fails_at;
  answer.limit_equilibrium.emplace();
  answer.limit_equilibrium->bishop.factor = 1.3;
  answer.limit_equilibrium->spencer.emplace().factor = 1.2;
  return answer;
}

}  // namespace

TEST_CASE("Factors of safety that are more than 5 % apart are reported") {
  CHECK(disagreement(answer_of(1.259, 1.27)).empty());
  CHECK_THAT(disagreement(answer_of(1.261, 1.27)),
             Contains("still stand at 1.261, 5 % above the 1.2 of limit equilibrium (Spencer on circles)"));
  CHECK(disagreement(answer_of(1.13, 1.141)).empty());
  CHECK_THAT(disagreement(answer_of(1.13, 1.139)),
             Contains("fail at 1.139, 5 % below the 1.2 of limit equilibrium (Spencer on circles)"));
  CHECK(disagreement(answer_of(1.1, 1.3)).empty());  // a wide bracket around it
}

TEST_CASE("One factor of safety alone has none to disagree with") {
  SafetyAnswer particles = answer_of(2, 2.1), surfaces = answer_of(2, 2.1);
  particles.limit_equilibrium.reset(), surfaces.particles.reset();
  CHECK(disagreement(particles).empty());
  CHECK(disagreement(surfaces).empty());
}
