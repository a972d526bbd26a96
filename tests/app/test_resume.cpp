// Runs that are stopped, resumed, or find somebody else's files in their folder.
#include <catch2/catch.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string endless =
    "run small.toml --set time.end=1e5 --set output.interval=10 --checkpoint-every 0.01";

/// Begins a run that would take days, and sends it the signal once it has written `file`. Its exit status.
int stop_endless_run(const Workplace& place, const std::string& signal, const std::string& file) {
  return place.shell("'" POROSPH_PROGRAM "' " + endless + " --quiet & while [ ! -e '" + file +
                     "' ]; do sleep 0.01; done; kill -" + signal + " $!; wait $!");
}

void spoil(const fs::path& file) {
  std::string text = text_of(file);
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("a signal ends a run with status 130, a checkpoint and whole files") {
  const Workplace place;
  place.write("small.toml", small_case);
  const std::string signal = GENERATE("TERM", "INT");
  CHECK(stop_endless_run(place, signal, "results/small/particles.pvd") == 130);
  const fs::path folder = place.folder() / "results/small";
  CHECK(fs::exists(folder / "checkpoint.bin"));
  CHECK_THAT(text_of(folder / "summary.json"), Contains("\"interrupted\""));
  CHECK(place.porosph("render results/small --field PorePressure --out p.png").status == 0);

  const Outcome again = place.porosph(endless);
  CHECK(again.status == 2);
  CHECK_THAT(again.err, Contains("--resume goes on with it, --force begins anew"));
  CHECK(fs::exists(folder / "checkpoint.bin"));
}

TEST_CASE("damaged checkpoints") {
  const Workplace place;
  place.write("small.toml", small_case);
  const std::string folder = "results/small/", newest = folder + "checkpoint.bin",
                    previous = folder + "checkpoint.previous.bin";
  REQUIRE(stop_endless_run(place, "KILL", previous) == 128 + 9);
  if (!fs::exists(place.folder() / newest))  // killed while one took the other's place
    fs::copy_file(place.folder() / previous, place.folder() / newest);

  SECTION("of two, the one before goes on") {
    spoil(place.folder() / newest);
    CHECK(place.shell("'" POROSPH_PROGRAM "' " + endless +
                      " --resume --quiet & while kill -0 $! && ! grep -q 'is used' err; do sleep 0.01; done; "
                      "kill -TERM $!; wait $!") == 130);
    CHECK_THAT(text_of(place.folder() / "err"),
               Contains("checkpoint.bin: it is damaged") && Contains("the checkpoint before it is used"));
  }
  SECTION("with none left there is one message, and nothing is changed") {
    spoil(place.folder() / newest);
    spoil(place.folder() / previous);
    const std::string history = text_of(place.folder() / folder / "history.csv");
    const Outcome outcome = place.porosph(endless + " --resume");
    CHECK(outcome.status == 4);
    CHECK_THAT(outcome.err, Contains("it is damaged") && Contains("--force"));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(text_of(place.folder() / folder / "history.csv") == history);
  }
  SECTION("history and frames must be those of the checkpoint") {
    place.write(folder + "history.csv", "time,A.EffectiveStress_XX\n0,1\n");
    const Outcome outcome = place.porosph(endless + " --resume");
    CHECK(outcome.status == 4);
    CHECK_THAT(outcome.err, Contains("history.csv: its columns are not those of the case"));
  }
  SECTION("a run without frames is not resumed with them, and the other way round") {
    const Outcome outcome = place.porosph(endless + " --resume --no-frames");
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains("was begun with frames"));
  }
}

TEST_CASE("resuming begins at the start where there is nothing, and is content where all is done") {
  const Workplace place;
  place.write("small.toml", small_case);
  const Outcome first = place.porosph("run small.toml --resume");
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("begins at the start"));
  const auto written = fs::last_write_time(place.folder() / "results/small/summary.json");
  const Outcome second = place.porosph("run small.toml --resume");
  CHECK(second.status == 0);
  CHECK_THAT(second.out, Contains("nothing to resume"));
  CHECK(fs::last_write_time(place.folder() / "results/small/summary.json") == written);
  CHECK_FALSE(fs::exists(place.folder() / "results/small/checkpoint.bin"));
}

TEST_CASE("another case's results are replaced only by force") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --out run --quiet").status == 0);
  CHECK(place.porosph("run small.toml --out run --quiet").status == 0);  // the same case: computed again
  const std::string other = "run small.toml --out run --quiet --no-frames --set time.end=0.5";
  for (const std::string option : {"", " --resume"}) {
    const Outcome refused = place.porosph(other + option);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains("run holds results of another case") && Contains("--force"));
  }
  CHECK(fs::exists(place.folder() / "run/particles.pvd"));
  CHECK(place.porosph(other + " --force").status == 0);
  CHECK_FALSE(fs::exists(place.folder() / "run/particles.pvd"));  // it was the other's
  CHECK(fs::is_empty(place.folder() / "run/frames"));
}

TEST_CASE("a person's own case file is not written over") {
  const Workplace place;
  const std::string mine = std::string("# remarks of mine\n") + small_case;
  place.write("case.toml", mine);
  const Outcome outcome = place.porosph("run case.toml --out . --set time.end=0.5");
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(". holds the case file of another case"));
  CHECK(text_of(place.folder() / "case.toml") == mine);
}

TEST_CASE("resuming and beginning anew exclude each other") {
  const Workplace place;
  place.write("small.toml", small_case);
  CHECK(place.porosph("run small.toml --resume --force").status == 2);
  CHECK(place.porosph("run small.toml --checkpoint-every 0").status == 2);
}
