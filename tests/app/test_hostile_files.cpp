// Results that somebody else has made or damaged: an error that names the file, and never a crash.
#include <catch2/catch.hpp>
#include <random>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

const Workplace& computed() {
  static const Workplace place;
  static const bool done = [] {
    place.write("small.toml", small_case);
    REQUIRE(place.porosph("run small.toml --quiet --out run --set output.interval=0").status == 0);
    REQUIRE(place.porosph("fem small.toml --out fem --edge 1").status == 0);
    return true;
  }();
  REQUIRE(done);
  return place;
}

struct Spoilt {
  std::string file, command;
};

/// Puts `content` in the place of a file while the command runs.
Outcome with_content(const Spoilt& spoilt, const std::string& content) {
  const Workplace& place = computed();
  const std::string sound = text_of(place.folder() / spoilt.file);
  place.write(spoilt.file, content);
  const Outcome outcome = place.porosph(spoilt.command);
  place.write(spoilt.file, sound);
  return outcome;
}

void check_refused(const Spoilt& spoilt, const Outcome& outcome) {
  CAPTURE(spoilt.file, spoilt.command, outcome.err);
  CHECK((outcome.status == 4 || outcome.status == 2));
  CHECK_THAT(outcome.err, Contains(spoilt.file));
}

const std::vector<Spoilt> readers = {
    {"run/particles.pvd", "render run --field PorePressure --out p.png"},
    {"run/frames/particles_000001.vtp", "render run --field PorePressure --out p.png"},
    {"run/case.toml", "report run --out page"},
    {"run/history.csv", "report run --out page"},
    {"run/summary.json", "report run --out page"},
    {"fem/fem.vtu", "compare run run --fem fem --out c"},
    {"fem/case.toml", "report run --fem fem --out page"},
};

}  // namespace

TEST_CASE("empty, foreign and cut files are refused by name") {
  for (const Spoilt& spoilt : readers) {
    const std::string sound = text_of(computed().folder() / spoilt.file);
    for (const std::string& content : {std::string(), std::string("\x89PNG\r\n\x1a\n\0\0", 10),
                                       std::string("<html></html>\n"), sound.substr(0, sound.size() / 2)}) {
      const bool torn_row = spoilt.file == "run/history.csv" && content.size() == sound.size() / 2;
      const Outcome outcome = with_content(spoilt, content);
      if (torn_row)
        CHECK(outcome.status == 0);  // as a killed run leaves it
      else
        check_refused(spoilt, outcome);
    }
  }
}

TEST_CASE("files with damaged bytes are read or refused, without a crash") {
  std::mt19937 chance(1);
  for (const Spoilt& spoilt : readers) {
    const std::string sound = text_of(computed().folder() / spoilt.file);
    for (int i = 0; i < 3; ++i) {
      std::string damaged = sound;
      for (int k = 0; k < 5; ++k) damaged[chance() % damaged.size()] = static_cast<char>(chance());
      const Outcome outcome = with_content(spoilt, damaged);
      if (outcome.status != 0) check_refused(spoilt, outcome);
    }
  }
}

TEST_CASE("a mesh whose triangles have nodes that are not there is refused") {
  const Spoilt spoilt{"fem/fem.vtu", "compare run run --fem fem --out c"};
  std::string text = text_of(computed().folder() / spoilt.file);
  const auto at = text.find("NumberOfCells=\"");
  REQUIRE(at != std::string::npos);
  check_refused(spoilt, with_content(spoilt, std::string(text).insert(at + 15, "99999999999")));
}

TEST_CASE("what a summary and a case say is text on the page, not markup") {
  const Workplace& place = computed();
  const std::string sound = text_of(place.folder() / "run/summary.json"),
                    evil = "<script>alert(1)</script><img src=x onerror='y'>";
  std::string summary = sound;
  const std::string mark = "\"message\": \"";
  summary.insert(summary.find(mark) + mark.size(), evil);
  place.write("run/summary.json", summary);
  CHECK(place.porosph("report run --out evil").status == 0);
  place.write("run/summary.json", sound);
  const std::string page = text_of(place.folder() / "evil/index.html");
  CHECK_THAT(page, !Contains("<script") && !Contains("<img src=x"));
}
