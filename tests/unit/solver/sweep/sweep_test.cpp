#include "solver/sweep/sweep.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <map>

#include "solver/case/case_file.hpp"
#include "solver/sweep/run_sweep.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// A sweep file, removed in the end.
class SweepFile {
 public:
  explicit SweepFile(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "porosph_sweep_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
    std::ofstream(path()) << text;
  }
  ~SweepFile() { fs::remove_all(folder_); }
  SweepFile(const SweepFile&) = delete;
  SweepFile& operator=(const SweepFile&) = delete;
  fs::path path() const { return folder_ / "two.toml"; }

 private:
  fs::path folder_;
};

const std::string head = "title = \"T\"\ncase = \"" POROSPH_SOURCE_DIR "/cases/verification/column.toml\"\n";
const std::string x_axis = "[x]\ntitle = \"C\"\nkey = \"time.courant\"\nvalues = [0.5, 0.9]\nquick = [0.9]\n";

std::string complaint(const std::string& text) {
  const SweepFile file(text);
  try {
    read_sweep(file.path(), false);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("a sweep file names its points", "[sweep]") {
  const SweepFile file(head + "set = [\"particles.spacing=0.5\"]\n" + x_axis +
                       "[y]\ntitle = \"E\"\nkey = \"soil.soil.youngs_modulus\"\nscale = 1e6\n"
                       "values = [15, {label = \"soft\", set = [\"soil.soil.youngs_modulus=1e6\"]}]\n");
  const Sweep sweep = read_sweep(file.path(), false);
  CHECK(sweep.name == "two");
  REQUIRE(sweep.size() == 4);
  CHECK(sweep.settings_of(1) == std::vector<std::string>{"particles.spacing=0.5", "time.courant=0.9",
                                                         "soil.soil.youngs_modulus=15000000"});
  CHECK(sweep.y.values[1].label == "soft");
  CHECK(sweep.settings_of(2).back() == "soil.soil.youngs_modulus=1e6");
  CHECK(usual_values(sweep, sweep.x) == std::vector<bool>{false, true});
  CHECK(usual_values(sweep, sweep.y) == std::vector<bool>{true, false});
  CHECK(read_sweep(file.path(), true).x.values.size() == 1);
}

TEST_CASE("what is wrong in a sweep file is named with its place", "[sweep]") {
  CHECK_THAT(complaint(head), Contains("key 'x'") && Contains("missing"));
  CHECK_THAT(complaint(head + "colour = 3\n" + x_axis),
             Contains("two.toml:3:") && Contains("'colour': is unknown"));
  CHECK_THAT(complaint(head + "reference = \"truth\"\n" + x_axis),
             Contains("must be one of case, weight_above, fem"));
  CHECK_THAT(complaint(head + "accurate_below = -1\n" + x_axis),
             Contains("'accurate_below': must be a number > 0"));
  CHECK_THAT(complaint(head + "[x]\ntitle = \"C\"\nkey = \"a\"\nvalues = []\n"),
             Contains("must be a list, not empty"));
  CHECK_THAT(complaint("title = "), Contains("two.toml:1:"));
}

TEST_CASE("an axis is given on the command line", "[sweep]") {
  const SweepAxis axis = parse_axis("soil.0.polygon=[[0,0],[1,0],[1,1]], [[0,0],[2,0],[2,2]]");
  CHECK(axis.title == "soil.0.polygon");
  REQUIRE(axis.values.size() == 2);
  CHECK(axis.values[1].settings == std::vector<std::string>{"soil.0.polygon=[[0,0],[2,0],[2,2]]"});
  const SweepAxis stiffness = parse_axis("soil.0.youngs_modulus=5 MPa,\"0.01 GPa\"");
  for (const auto& [value, modulus] : {std::pair{0, 5e6}, {1, 1e7}})
    CHECK(read_case(POROSPH_SOURCE_DIR "/cases/verification/column.toml", stiffness.values[value].settings)
              .soils[0]
              .youngs_modulus == modulus);
  CHECK_THROWS_AS(parse_axis("time.courant"), CaseError);
  CHECK_THROWS_AS(parse_axis("time.courant=1,,2"), CaseError);
}

TEST_CASE("a sweep runs what is not known, and refuses what is not a case", "[sweep]") {
  Sweep sweep;
  sweep.case_file = POROSPH_SOURCE_DIR "/cases/verification/column.toml";
  sweep.settings = {"particles.spacing=1", "loading.damping=0.3"};
  sweep.x = parse_axis("time.courant=-1,0.8,0.9");
  sweep.y = {"", {{"", {}}}};
  sweep.limits.accurate = 0.1;
  std::map<std::size_t, std::string> finished;
  const SweepWatch watch{
      .known =
          [](std::size_t i, const std::string&) {
            Verdict v;
            v.outcome = StabilityClass::thrown_out;
            return i == 1 ? std::optional(v) : std::nullopt;
          },
      .finished = [&](std::size_t i, const std::string& f, const Verdict&) { finished[i] = f; },
      .interrupted = {}};
  const auto verdicts = run_sweep(sweep, exact_measure, 2, watch);
  REQUIRE(verdicts.size() == 3);
  CHECK(verdicts[0]->outcome == StabilityClass::refused);
  CHECK_THAT(verdicts[0]->message, Contains("time.courant"));
  CHECK(verdicts[1]->outcome == StabilityClass::thrown_out);
  CHECK(verdicts[2]->outcome == StabilityClass::accurate);
  CHECK(verdicts[2]->error < 0.02);
  CHECK(finished.size() == 2);
  CHECK(finished[0] != finished[2]);
  const auto none =
      run_sweep(sweep, exact_measure, 2, {.known = {}, .finished = {}, .interrupted = [] { return true; }});
  for (const auto& verdict : none) CHECK_FALSE(verdict);
}
