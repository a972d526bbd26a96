// The bench command on the smallest sizes: that it works, not how fast.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

const std::string cases = " --cases " POROSPH_SOURCE_DIR "/cases ";

}  // namespace

TEST_CASE("bench writes a page, pictures and tables of what it measured and left out") {
  const Workplace place;
  const Outcome outcome = place.porosph("bench --quick --particles 1100 --threads 1 --out b" + cases);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("b/index.html") && Contains("error with geometry refreshed when due"));
  CHECK_THAT(outcome.out, Contains("left out: embankment"));  // 1358 particles at least
  for (const char* picture : {"throughput.png", "phases.png", "work_precision.png"})
    CHECK(text_of(place.folder() / "b" / picture).starts_with("\x89PNG"));
  CHECK_THAT(text_of(place.folder() / "b/throughput.csv"),
             Contains("plain loops,1,1014,") && Contains("consistent (default),1,1014,"));
  CHECK_THAT(text_of(place.folder() / "b/phases.csv"), Contains("consistent,1014,strain,"));
  CHECK_THAT(text_of(place.folder() / "b/work_precision.csv"), Contains("foundation,plain loops,"));
  CHECK_FALSE(std::filesystem::exists(place.folder() / "b/phases_frames"));
  const auto study = nlohmann::json::parse(text_of(place.folder() / "b/study.json"));
  CHECK(study["title"] == "Speed");
  CHECK(study["sections"].size() == 5);
}

TEST_CASE("bench refuses what it cannot do") {
  const Workplace place;
  const auto [arguments, message] = GENERATE(table<std::string, std::string>({
      {"--only speed", "--only = speed: must be one of throughput, phases, work-precision"},
      {"--threads 0", "--threads = 0: must be from 1 to 1024"},
      {"--particles 10", "--particles = 10: must be at least 100"},
      {"--fast", "unrecognised option"},
      {"--quick --only phases", "cases/foundation.toml: say with --cases"},
  }));
  const Outcome outcome = place.porosph("bench " + arguments);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(message));
}
