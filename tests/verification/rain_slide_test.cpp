// A slope that rain lets slide: the shipped case, with less time in motion.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/kept_state.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

constexpr double hour = 3600, motion_time = 4;

Case slope() { return scene("failure/rain_slide", {"water.motion_time=4"}); }

}  // namespace

TEST_CASE("rain lets a slope slide, and its history continues", "[water][dynamic]") {
  Simulation s(slope());
  std::size_t rows_in_motion = 0;
  double rested_at = 0;  // the displacement
  RunWatch watch;
  watch.history = [&](const std::vector<double>& row) {
    CHECK(row.size() == history_columns(s).size());
    if (!s.in_motion()) rested_at = s.largest_displacement();
    rows_in_motion += s.in_motion() ? 1 : 0;
  };
  run_to_end(s, watch);
  REQUIRE(s.in_motion());
  CHECK(s.failed_at() > 48 * hour);
  CHECK(s.failed_at() < 96 * hour);
  CHECK(s.time() == Approx(s.failed_at() + motion_time).margin(1e-3));
  CHECK(rows_in_motion >= 8);  // one in half a second
  CHECK(s.largest_displacement() > 4 * rested_at);
  CHECK(std::abs(s.seepage()->richards().balance().error()) < 1e-8);
}

TEST_CASE("a slide continues to the same bits from a kept state", "[water][dynamic]") {
  Simulation first(slope()), second(slope());
  first.begin();
  while (!first.in_motion() && first.step() < first.last_step()) first.advance();
  REQUIRE(first.in_motion());
  for (int k = 0; k < 100; ++k) first.advance();
  KeptState(first).restore(second);
  for (int k = 0; k < 100; ++k) first.advance(), second.advance();
  REQUIRE_FALSE(first.instability());
  CHECK(KeptState(first) == KeptState(second));
}
