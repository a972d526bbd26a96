// What the measurements are condensed into.
#include <catch2/catch.hpp>

#include "app/bench/asked.hpp"
#include "app/bench/csv.hpp"
#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

using namespace porosph;
using namespace porosph::bench;

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// The row whose first cell contains the text.
std::vector<std::string> row_of(const Rows& rows, const std::string& text) {
  for (const auto& row : rows)
    if (row[0].find(text) != std::string::npos) return row;
  return {};
}

ThroughputPoint point(std::int64_t particles, int threads, double rate, double ratio) {
  return {.contender = default_contender,
          .threads = threads,
          .particles = particles,
          .rate = {rate, rate, rate},
          .ratio_to_plain = {ratio, ratio, ratio},
          .bytes_per_particle = 800};
}

WorkPoint run(const std::string& form, const std::string& strategy, double spacing, const std::string& ending,
              double error, double seconds, double settled) {
  return {.scene = "foundation",
          .form = form,
          .strategy = strategy,
          .spacing = spacing,
          .ending = ending,
          .error = error,
          .seconds = {seconds, seconds, seconds},
          .settled = {settled, settled, settled}};
}

}  // namespace

TEST_CASE("The median and the range of measurements") {
  const Spread odd = spread_of({3, 1, 2}), even = spread_of({4, 1, 2, 3});
  CHECK(odd.median == 2);
  CHECK(odd.low == 1);
  CHECK(odd.high == 3);
  CHECK(even.median == 2.5);
  CHECK(text({10, 9, 11}) == "10 ± 10 %");
  CHECK(text({10, 10, 10}) == "10");
  CHECK_THROWS_AS(spread_of({}), std::invalid_argument);
}

TEST_CASE("Tables for other programs quote what would break a row") {
  const test::TemporaryFolder folder;
  write_csv(folder / "t.csv", {{"a", "b, c"}, {"say \"x\"", digits(0.1)}});
  CHECK(read_file(folder / "t.csv") == "a,\"b, c\"\n\"say \"\"x\"\"\",0.1\n");
}

TEST_CASE("What is asked stands beside what was measured at that size") {
  Throughput t;
  t.points = {point(3750, 1, 24e6, 18), point(10086, 1, 24e6, 20), point(99846, 1, 20e6, 15),
              point(99846, 2, 36e6, 0), point(998784, 1, 12e6, 12)};
  const Rows rows = asked_table(t, std::nullopt, 2);
  CHECK(row_of(rows, "plain loops, 3750") ==
        std::vector<std::string>{"particle-steps per second against plain loops, 3750 particles",
                                 "at least 12 times", "18", "1.50"});
  CHECK(row_of(rows, "plain loops, 998784")[3] == "1.50");
  CHECK(row_of(rows, "2 threads")[2] == "1.80 times");
  CHECK(row_of(rows, "10^6 against 10^4")[2] == "2.00 times");
  CHECK(row_of(rows, "10^6 against 10^4")[3] == "0.70");
  CHECK(row_of(rows, "memory")[3] == "1.25");
  CHECK(row_of(asked_table(std::nullopt, WorkPrecision{}, 2), "foundation").empty());
}

TEST_CASE("The fastest run that is accurate enough stands against the paper's procedure") {
  WorkPrecision work;
  work.points = {run(plain_form, paper_strategy, 0.2, "end of time", 0.0196, 40, 30),
                 run(consistent_form, rest_strategy, 0.5, "equilibrium", 0.005, 0.01, 0.01),
                 run(consistent_form, rest_strategy, 0.1, "equilibrium", 0.0004, 3, 2),
                 run(consistent_form, rest_strategy, 0.15, "equilibrium", 0.0009, 0.2, 0.1)};
  auto row = row_of(asked_table(std::nullopt, work, 1), "foundation");
  CHECK(row[2] == "150 times");  // 30 s until it has settled, against 0.2 s until it stopped
  CHECK(row[3] == "1.50");
  work.points.resize(2);
  row = row_of(asked_table(std::nullopt, work, 1), "foundation");
  CHECK(row[2] == "3000 times, 0.1 % not reached");
}
