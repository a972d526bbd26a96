// Runs that are stopped, resumed, or find somebody else's files in their folder.
#include <catch2/catch.hpp>
#include <map>

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
  const std::string signal = GENERATE("TERM", "INT", "HUP");
  CHECK(stop_endless_run(place, signal, "results/small/particles.pvd") == 130);
  const fs::path folder = place.folder() / "results/small";
  CHECK(fs::exists(folder / "checkpoint.bin"));
  CHECK_THAT(text_of(folder / "summary.json"), Contains("\"interrupted\""));
  CHECK(place.porosph("render results/small --field PorePressure --out p.png").status == 0);

  const Outcome again = place.porosph(endless);
  CHECK(again.status == 2);
  CHECK_THAT(again.err, Contains("--resume continues it, --force starts it again"));
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

  SECTION("of two, the earlier one is used") {
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
    CHECK_THAT(outcome.err, Contains("was started with frames"));
  }
}

TEST_CASE("resuming begins at the start where there is nothing, and is content where all is done") {
  const Workplace place;
  place.write("small.toml", small_case);
  const Outcome first = place.porosph("run small.toml --resume");
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("starts at the beginning"));
  const auto written = fs::last_write_time(place.folder() / "results/small/summary.json");
  const Outcome second = place.porosph("run small.toml --resume");
  CHECK(second.status == 0);
  CHECK_THAT(second.out, Contains("nothing to resume"));
  CHECK(fs::last_write_time(place.folder() / "results/small/summary.json") == written);
  CHECK_FALSE(fs::exists(place.folder() / "results/small/checkpoint.previous.bin"));
}

namespace {

/// The files that a run writes, but for those with its folder or its run time in them.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    const bool is_the_same = name != "checkpoint.bin" && name != "summary.json" && !name.ends_with(".py");
    if (entry.is_regular_file() && is_the_same) files[name] = text_of(entry.path());
  }
  return files;
}

}  // namespace

TEST_CASE("a finished run is resumed to a later end, as if it had had it from the start") {
  const Workplace place;
  place.write("small.toml", small_case);
  // 0.1 s between frames: 0.55 s is not a multiple of it, so the last frame of the short run must go
  const std::string run = "run small.toml --quiet --set time.end=";
  REQUIRE(place.porosph(run + "0.55 --out parts").status == 0);
  const Outcome second = place.porosph(run + "1.3 --out parts --resume");
  CAPTURE(second.err);
  REQUIRE(second.status == 0);
  const std::string case_text = text_of(place.folder() / "parts/case.toml");
  const auto at = case_text.find("\nstep = ");
  REQUIRE(at != std::string::npos);
  const std::string step = case_text.substr(at + 8, case_text.find(' ', at + 8) - at - 8);
  REQUIRE(place.porosph(run + "1.3 --out whole --set time.step=" + step).status == 0);
  CHECK(files_of(place.folder() / "parts") == files_of(place.folder() / "whole"));
  CHECK_THAT(text_of(place.folder() / "parts/summary.json"), Contains("\"completed\""));

  const Outcome again = place.porosph("run small.toml --set time.end=1.3 --out parts --resume");
  CHECK(again.status == 0);
  CHECK_THAT(again.out, Contains("nothing to resume"));
  const Outcome earlier = place.porosph(run + "0.9 --out parts --resume");
  CHECK(earlier.status == 2);
  CHECK_THAT(earlier.err, Contains("the run in parts goes to 1.3 s"));
  CHECK(place.porosph(run + "1.3 --out parts --resume --set loading.damping=0.04").status == 2);
  fs::remove(place.folder() / "parts/checkpoint.bin");
  const Outcome gone = place.porosph(run + "2 --out parts --resume");
  CHECK(gone.status == 2);
  CHECK_THAT(gone.err, Contains("does not hold the state at the end of its run"));
}

TEST_CASE("results that were changed are not continued") {
  const Workplace place;
  place.write("small.toml", small_case);
  const std::string run = "run small.toml --quiet --out run --set time.end=";
  REQUIRE(place.porosph(run + "0.5").status == 0);
  const auto check_refused = [&](const std::string& file, const std::string& content,
                                 const std::string& said) {
    const std::string sound = text_of(place.folder() / file);
    REQUIRE(content != sound);
    place.write(file, content);
    const Outcome outcome = place.porosph(run + "1 --resume");
    CAPTURE(file, outcome.err);
    CHECK(outcome.status == 4);
    CHECK_THAT(outcome.err, Contains(file) && Contains(said) && Contains("--force starts it again"));
    place.write(file, sound);
  };
  const std::string history = text_of(place.folder() / "run/history.csv");
  const auto third_line = history.find('\n', history.find('\n') + 1) + 1;
  std::string edited = history, shorter = history;
  edited[history.find('\n', third_line) - 1] ^= 1;  // another digit
  shorter.erase(third_line, history.find('\n', third_line) + 1 - third_line);
  check_refused("run/history.csv", edited, "are not those that the run wrote");
  check_refused("run/history.csv", shorter, "are not those that the run wrote");
  check_refused("run/history.csv", history.substr(0, third_line), "no row at");
  std::string renamed = history;
  renamed.replace(renamed.find("A.Eff"), 5, "B.Eff");
  check_refused("run/history.csv", renamed, "columns");
  const std::string frame = "run/frames/particles_000002.vtp";
  check_refused(frame, text_of(place.folder() / "run/frames/particles_000001.vtp"),
                "not the file that the run wrote");
  CHECK(place.porosph(run + "1 --resume").status == 0);
}

TEST_CASE("a reader of the output that leaves does not end the run") {
  const Workplace place;
  place.write("small.toml", small_case);
  const int status =
      place.shell("{ '" POROSPH_PROGRAM "' run small.toml --out run 2>&1; echo $? > status; } | true");
  CHECK(status == 0);
  CHECK(text_of(place.folder() / "status") == "0\n");
  CHECK_THAT(text_of(place.folder() / "run/summary.json"), Contains("\"completed\""));
}

TEST_CASE("a run that ignores hang-ups, as under nohup, continues after one") {
  const Workplace place;
  place.write("small.toml", small_case);
  const int status =
      place.shell("trap '' HUP; '" POROSPH_PROGRAM "' " + endless +
                  " --quiet & while [ ! -e results/small/checkpoint.bin ]; do sleep 0.01; done; "
                  "kill -HUP $!; sleep 0.3; kill -0 $! && kill -TERM $!; wait $!");
  CHECK(status == 130);
}

TEST_CASE(
    "the steps that disorder asks for stand in the case and the summary, and are the same when repeated") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place
              .porosph("run small.toml --quiet --out first --set time.end=0.05 "
                       "--set particles.arrangement=disordered --set particles.disorder=0.4")
              .status == 0);
  CHECK_THAT(text_of(place.folder() / "first/case.toml"),
             Contains("# The stiffest of the particles allow a Courant number of 0."));
  CHECK_THAT(text_of(place.folder() / "first/summary.json"),
             Contains("\"courant\": 0.") && !Contains("\"courant\": 0.4,"));
  REQUIRE(place.porosph("run first/case.toml --quiet --out second").status == 0);
  CHECK(files_of(place.folder() / "first") == files_of(place.folder() / "second"));
}

TEST_CASE("another case's results are replaced only by force") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --out run --quiet").status == 0);
  CHECK(place.porosph("run small.toml --out run --quiet").status == 0);  // the same case: computed again
  const std::string other =
      "run small.toml --out run --quiet --no-frames --set time.end=0.5 --set loading.damping=0.04";
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

TEST_CASE("resuming and starting over exclude each other") {
  const Workplace place;
  place.write("small.toml", small_case);
  CHECK(place.porosph("run small.toml --resume --force").status == 2);
  CHECK(place.porosph("run small.toml --checkpoint-every 0").status == 2);
}
