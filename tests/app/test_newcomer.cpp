// What a newcomer meets: help, a case to start from, the shipped cases, completion, the manual page.
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// The subcommands that the overview names.
std::set<std::string> subcommands(const Workplace& place) {
  const std::string overview = place.porosph("--help").out;
  const std::regex line("\n  ([a-z]+) +[a-z]");
  std::set<std::string> names;
  for (std::sregex_iterator i(overview.begin(), overview.end(), line), end; i != end; ++i)
    if ((*i)[1] != "porosph") names.insert((*i)[1]);
  return names;
}

std::set<std::string> long_options(const std::string& text) {
  const std::regex option("\n  (?:-[a-z] \\[ )?(--[a-z0-9-]+)");
  std::set<std::string> names;
  for (std::sregex_iterator i(text.begin(), text.end(), option), end; i != end; ++i) names.insert((*i)[1]);
  return names;
}

/// What bash would offer after this line.
std::string offered(const Workplace& place, const std::string& line) {
  place.write("complete.sh", "PATH=\"$(dirname '" POROSPH_PROGRAM
                             "'):$PATH\"\nsource <(porosph completion bash)\n"
                             "compopt() { :; }\nCOMP_LINE='" +
                                 line + "' COMP_POINT=" + std::to_string(line.size()) +
                                 "\n_porosph\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const std::string command = "cd '" + place.folder().string() + "' && bash complete.sh > offered 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
  return text_of(place.folder() / "offered");
}

}  // namespace

TEST_CASE("init writes a case that runs as it is") {
  const Workplace place;
  CHECK_THAT(place.porosph("init").out, Contains("my_slope.toml") && Contains("porosph run my_slope.toml"));
  CHECK_THAT(
      text_of(place.folder() / "my_slope.toml"),
      Contains("# Distance of neighbouring particles, dx. [m]") && Contains("\n#smoothing_ratio = 1\n"));
  const Outcome again = place.porosph("init");
  CHECK(again.status == 2);
  CHECK_THAT(again.err, Contains("--force"));
  CHECK(place.porosph("init --force").status == 0);
  CHECK(place.porosph("init case.txt").status == 2);
  CHECK(place.porosph("init no/folder.toml").status == 4);
  const Outcome run = place.porosph(
      "run my_slope.toml --set particles.spacing=0.5 --set loading.damping=0.04 --set time.end=6");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("in equilibrium"));
}

TEST_CASE("list names the cases, which run, check and fem understand") {
  const Workplace place;
  const std::string list = place.porosph("list").out;
  CHECK_THAT(list,
             Contains("foundation ") && Contains("Submerged foundation") && Contains("verification/column"));
  const std::string names = place.porosph("list --names").out;
  CHECK_THAT(names, Contains("embankment\n") && Contains("verification/patch\n"));
  CHECK(std::count(names.begin(), names.end(), '\n') ==
        std::count(list.begin(), list.end(), '\n') - 2);  // an empty line and what to do next
  CHECK_THAT(place.porosph("list --paths").out, Contains("/share/porosph/cases/foundation.toml\n"));
  CHECK(place.porosph("run foundation --quiet --no-frames --set time.end=0.001").status == 0);
  CHECK(std::filesystem::exists(place.folder() / "results/foundation/summary.json"));
  CHECK(place.porosph("run foundatio").status == 2);
}

TEST_CASE("every subcommand is in completion and manual page with all its options") {
  const Workplace place;
  const std::string man = std::regex_replace(place.porosph("man").out, std::regex(R"(\\-)"), "-");
  const std::set<std::string> commands = subcommands(place);
  CHECK(commands.size() >= 10);
  for (const std::string& command : commands) {
    CAPTURE(command);
    CHECK_THAT(man, Contains(".SS porosph " + command));
    const std::set<std::string> options = long_options(place.porosph(command + " --help").out);
    const std::string bash = offered(place, "porosph " + command + " --");
    for (const std::string& option : options) {
      CAPTURE(option);
      CHECK_THAT(man, Contains(".B " + option));
      CHECK_THAT(bash, Contains(option + "\n"));
    }
  }
}

TEST_CASE("the manual page tells of all files of a run, of what the environment sets and of all statuses") {
  const Workplace place;
  const std::string man = std::regex_replace(place.porosph("man").out, std::regex(R"(\\-)"), "-");
  place.write("mine.toml", small_case);
  REQUIRE(place.porosph("run mine.toml --quiet --out run").status == 0);
  for (const auto& entry : std::filesystem::directory_iterator(place.folder() / "run")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(".")) CHECK_THAT(man, Contains(name));
  }
  const std::regex reads(R"re((?:getenv|is_set)\("(\w+)"\))re");
  int variables = 0;
  for (const std::string folder : {"app", "render", "vtk_io", "solver"})
    for (const auto& file :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(POROSPH_SOURCE_DIR) / folder)) {
      if (file.path().extension() != ".cpp") continue;
      const std::string text = text_of(file.path());
      for (std::sregex_iterator it(text.begin(), text.end(), reads), end; it != end; ++it, ++variables)
        CHECK_THAT(man, Contains(".B " + it->str(1)));
    }
  CHECK(variables >= 5);
  for (const char* status : {"0", "1", "2", "3", "4", "130"})
    CHECK_THAT(man, Contains(std::string(".B ") + status + "\n"));
}

TEST_CASE("bash completes subcommands, cases, settings, fields and files") {
  const Workplace place;
  place.write("mine.toml", small_case);
  CHECK(offered(place, "porosph re") == "render\nreport\n");
  CHECK_THAT(offered(place, "porosph run "), Contains("mine.toml\n") && Contains("foundation\n"));
  CHECK(offered(place, "porosph run verification/col") == "verification/column\n");
  CHECK(offered(place, "porosph run x.toml --set formulation.motion=p") == "proposed\n");
  CHECK(offered(place, "porosph run x.toml --set particles.spa") == "particles.spacing=\n");
  CHECK(offered(place, "porosph render x --field EffectiveStress:Y") == "YY\nYZ\n");
  CHECK(offered(place, "porosph compare a b --time ") == "last\ncommon\n");
  CHECK(place.porosph("completion zsh").status == 2);
}

TEST_CASE("colours are printed on a terminal only, and not with NO_COLOR") {
  const Workplace place;
  const auto on_terminal = [&](const std::string& environment) {
    const std::string command = "cd '" + place.folder().string() + "' && env -u NO_COLOR " + environment +
                                " script -qec \"'" POROSPH_PROGRAM "' --help\" /dev/null > typed";
    REQUIRE(std::system(command.c_str()) == 0);
    return text_of(place.folder() / "typed");
  };
  const std::string escape = "\x1b[";
  CHECK_THAT(on_terminal("TERM=xterm"), Contains(escape));
  CHECK_THAT(on_terminal("TERM=xterm NO_COLOR=1"), !Contains(escape) && Contains("Usage:"));
  CHECK_THAT(on_terminal("TERM=dumb"), !Contains(escape));
  CHECK_THAT(place.porosph("--help").out, !Contains(escape));
}

TEST_CASE("a wrong subcommand is answered with the one that was meant") {
  const Workplace place;
  CHECK_THAT(place.porosph("rum").err, Contains("did you mean 'run'?"));
  CHECK_THAT(place.porosph("run").err, Contains("a case is missing") && Contains("porosph run CASE.toml"));
}

TEST_CASE("fields that are written on request can be drawn, and a boundary beside them does not disturb") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place
              .porosph(
                  "run small.toml --quiet --out run --set output.boundary=true --set output.format=vtu --set "
                  "output.compression=none --set 'output.fields=[\"PrincipalStress\", \"MeanStress\", "
                  "\"DeviatoricStress\", \"VonMisesStress\", \"Strain\", \"ExcessStress\"]'")
              .status == 0);
  CHECK(std::filesystem::exists(place.folder() / "run/frames/boundary_000000.vtu"));
  for (const std::string field : {"PrincipalStress:S1", "MeanStress", "DeviatoricStress:XY", "VonMisesStress",
                                  "Strain:YY", "ExcessStress:YY"}) {
    CAPTURE(field);
    const Outcome drawn = place.porosph("render run --out p.png --field " + field);
    CHECK(drawn.status == 0);
    CHECK(std::filesystem::file_size(place.folder() / "p.png") > 5000);
  }
  CHECK_THAT(place.porosph("render run --field PrincipalStress").err, Contains("PrincipalStress:S1"));
}
