#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/verdict_table.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

VerdictRow row(const std::string& x, StabilityClass outcome) {
  VerdictRow r{x, "eq. (24), alpha = 0", "00ff", {}};
  const bool broken = outcome == StabilityClass::unstable;
  r.verdict = {.outcome = outcome,
               .cause = broken ? "not finite" : "",
               .time = 0.1,
               .steps = 7,
               .error = broken ? std::nan("") : 1.0 / 3,
               .unbalanced = 1e-9,
               .energy_growth = -0.5,
               .message = broken ? "at 0.1 s, particle \"3\"\nwas lost" : ""};
  return r;
}

}  // namespace

TEST_CASE("verdicts come back as they were, line breaks aside") {
  const TemporaryFolder folder;
  write_verdicts(folder / "map.csv", {row("[1, 2]", StabilityClass::accurate)});
  VerdictWriter(folder / "map.csv", read_verdicts(folder / "map.csv"))
      .append(row("0.5", StabilityClass::unstable));
  const auto rows = read_verdicts(folder / "map.csv");
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].x == "[1, 2]");
  CHECK(rows[0].y == "eq. (24), alpha = 0");
  CHECK(rows[0].verdict.outcome == StabilityClass::accurate);
  CHECK(rows[0].verdict.error == 1.0 / 3);
  CHECK(rows[1].fingerprint == "00ff");
  CHECK(rows[1].verdict.outcome == StabilityClass::unstable);
  CHECK(rows[1].verdict.cause == "not finite");
  CHECK(std::isnan(rows[1].verdict.error));
  CHECK(rows[1].verdict.steps == 7);
  CHECK(rows[1].verdict.message == "at 0.1 s, particle \"3\"[U+000A]was lost");
}

TEST_CASE("a torn last verdict is left out, a wrong one is named with its line") {
  const TemporaryFolder folder;
  write_verdicts(folder / "map.csv",
                 {row("1", StabilityClass::accurate), row("2", StabilityClass::accurate)});
  const std::string text = content(folder / "map.csv");
  put(folder / "torn.csv", text.substr(0, text.size() - 9));
  CHECK(read_verdicts(folder / "torn.csv").size() == 1);
  put(folder / "wrong.csv", text + "a,b,c\n");
  CHECK_THROWS_WITH(read_verdicts(folder / "wrong.csv"), Contains("line 4") && Contains("3 fields"));
  put(folder / "zero.csv", text + "a,b" + '\0' + "\n");
  CHECK_THROWS_WITH(read_verdicts(folder / "zero.csv"), Contains("line 4") && Contains("2 fields"));
  put(folder / "large.csv", text + "a,b,accurate,,1,1e99,0,0,0,f,\n");
  CHECK_THROWS_WITH(read_verdicts(folder / "large.csv"), Contains("'1e99' is not a whole number"));
  put(folder / "open.csv", text + "\"a,b,accurate,,1,1,0,0,0,f,\n");
  CHECK_THROWS_WITH(read_verdicts(folder / "open.csv"), Contains("line 4: a quote is not closed"));
  put(folder / "other.csv", "time,A\n");
  CHECK_THROWS_AS(read_verdicts(folder / "other.csv"), ReadError);
}
