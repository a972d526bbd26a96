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

TEST_CASE("text that a terminal obeys is refused in every file that is shown") {
  const auto check_refused_with = [](const Spoilt& spoilt, const std::string& old, const std::string& bad) {
    std::string text = text_of(computed().folder() / spoilt.file);
    const auto at = text.find(old);
    REQUIRE(at != std::string::npos);
    const Outcome outcome = with_content(spoilt, text.replace(at, old.size(), bad));
    check_refused(spoilt, outcome);
    CHECK_THAT(outcome.err, Contains("control characters") && !Contains("\x1b"));
  };
  check_refused_with({"run/summary.json", "report run --out page"}, "\"message\": \"",
                     "\"message\": \"\\u001b[2J");
  check_refused_with({"run/summary.json", "run small.toml --out run --resume --set output.interval=0"},
                     "\"message\": \"", "\"message\": \"\\u001b[2J");
  check_refused_with({"run/history.csv", "report run --out page"}, "A.PorePressure", "A.\x1b[2JPressure");
  check_refused_with({"run/case.toml", "report run --out page"}, "title = \"Small", "title = \"\\u001b[2J");
  check_refused_with({"run/frames/particles_000001.vtp", "render run --field PorePressure --out p.png"},
                     "Name=\"Velocity\"", "Name=\"V&#x9b;2Jcity\"");
  const Outcome option = computed().porosph("render run --field \"$(printf '\\033[2J')\"");
  CHECK(option.status == 2);
  CHECK_THAT(option.err, Contains("[U+001B][2J") && !Contains("\x1b"));
}

TEST_CASE("a field's name leads to no other folder") {
  const Workplace& place = computed();
  const fs::path frame = place.folder() / "run/frames/particles_000001.vtp";
  const std::string sound = text_of(frame);
  std::string evil = sound;
  const std::string name = "Name=\"PorePressure\"";
  evil.replace(evil.find(name), name.size(), "Name=\"../../../../x\"");
  place.write("run/frames/particles_000001.vtp", evil);
  const Outcome outcome = place.porosph("render run --field ../../../../x");
  place.write("run/frames/particles_000001.vtp", sound);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out == "run/____________x.png\n");
  CHECK(fs::exists(place.folder() / "run/____________x.png"));
}

TEST_CASE("a study's symbolic links and outside files are not copied into a report") {
  const Workplace& place = computed();
  fs::create_directories(place.folder() / "study");
  place.write("secret.png", "private");
  const auto study = [](const std::string& file) {
    return R"({"title": "S", "lead": "", "files": [], "command": "", "sections": [{"heading": "H", "paragraphs": [],
      "tables": [], "pictures": [{"file": ")" +
           file + R"(", "description": "", "caption": ""}]}]})";
  };
  fs::create_symlink(place.folder() / "secret.png", place.folder() / "study/a.png");
  for (const std::string file : {"a.png", "../secret.png", "", ".."}) {
    CAPTURE(file);
    place.write("study/study.json", study(file));
    const Outcome outcome = place.porosph("report run study --out with_study");
    CHECK(outcome.status == 4);
    CHECK_THAT(outcome.err, Contains(file == "a.png" ? "symbolic link" : "not a file in the study's folder"));
  }
  CHECK_FALSE(fs::exists(place.folder() / "with_study/study_1_a.png"));
  place.write("study/study.json", "{\"title\": \"\\u001b[2J\"}");
  const Outcome outcome = place.porosph("report run study --out with_study");
  CHECK(outcome.status == 4);
  CHECK_THAT(outcome.err, Contains("study.json") && Contains("control characters"));
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
  CHECK_THAT(page, !Contains("<script>alert") && !Contains("<img src=x"));
  CHECK(page.find("<script") == page.rfind("<script"));  // the page's own
}
