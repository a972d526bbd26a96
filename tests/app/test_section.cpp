// porosph section, of a run against the theory of its case.
#include <boost/algorithm/string.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/app/porosph.hpp"
#include "tests/unit/render/image.hpp"

using namespace porosph;
using namespace porosph::render;
using Catch::Matchers::Contains;

namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> table_of(const std::filesystem::path& csv) {
  std::istringstream lines(text_of(csv));
  std::vector<std::string> head;
  std::vector<Row> rows;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    boost::split(cells, line, [](char c) { return c == ','; });
    if (head.empty()) {
      head = cells;
      continue;
    }
    REQUIRE(cells.size() == head.size());
    for (std::size_t i = 0; i < head.size(); ++i)
      i == 0 ? rows.emplace_back()[head[i]] = cells[i] : rows.back()[head[i]] = cells[i];
  }
  return rows;
}

double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

/// A column's value at a height, linear between the rows of one curve.
double at_height(const std::vector<Row>& rows, const std::string& run, double y, const std::string& column) {
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const Row &a = rows[i], &b = rows[i + 1];
    if (a.at("run") != run || b.at("run") != run) continue;
    const double low = number(a, "y"), high = number(b, "y");
    if (low <= y && y <= high)
      return number(a, column) + (y - low) / (high - low) * (number(b, column) - number(a, column));
  }
  return NAN;
}

const char* const theory = "theory; at rest";

}  // namespace

TEST_CASE("vertical stress on sections of a foundation is that of theory, up to walls and floor") {
  const Workplace place;
  const std::string foundation =
      "run '" POROSPH_SOURCE_DIR "/cases/foundation_fast.toml' --quiet --threads 1 ";
  for (const char* spacing : {"0.5", "0.25"}) {
    CAPTURE(spacing);
    REQUIRE(place.porosph(foundation + "--force --out run --set particles.spacing=" + spacing).status == 0);
    for (const char* x : {"0", "0.03", "7.5", "15"}) {
      CAPTURE(x);
      const Outcome done = place.porosph(std::string("section run --field EffectiveStress:YY --field "
                                                     "TotalStress:YY --out at.png --vertical ") +
                                         x);
      REQUIRE(done.status == 0);
      CHECK_THAT(done.out, Contains("1 stretch of soil"));
      CHECK(Image(place.folder() / "at.png").width() == 960);
      place.shell("sed -i 's/\"theory, at rest\"/theory; at rest/' at.csv");
      const std::vector<Row> rows = table_of(place.folder() / "at.csv");
      CHECK(number(rows.front(), "y_start") == Approx(0).margin(0.01));
      for (const double y : {0.1, 0.5, 3.3, 8.}) {
        CAPTURE(y);
        for (const char* field : {"EffectiveStress_YY", "TotalStress_YY"})
          CHECK(at_height(rows, "run", y, field) == Approx(at_height(rows, theory, y, field)).epsilon(0.005));
      }
    }
  }
  const Outcome several = place.porosph(
      "section run --level 0.1 --time 0.1 --time last --field StressObliquity --field Head --out "
      "level.png");
  CHECK(several.status == 0);
  CHECK_THAT(several.out, Contains("run, t = ") && Contains("total stress:"));
}

TEST_CASE("a section says what it needs") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --quiet --out run").status == 0);
  for (const auto& [arguments, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"section run", "a section needs one of --vertical X, --level Y, or --from X,Y with --to X,Y"},
           {"section run --vertical 1 --level 2", "a section needs one of"},
           {"section run --from 1,1", "--from X,Y and --to X,Y are needed together"},
           {"section run --from 1,1 --to 1", "--to = 1: must be X,Y"},
           {"section run --from 1,1 --to 1,1", "has the point (1, 1) twice in a row"},
           {"section run --vertical 3",
            "the section x = 3 m does not meet the soil of run, which lies between"},
           {"section run --vertical 1 --field Stress", "the series has no field 'Stress'"},
           {"section run --vertical 1 --points 1", "--points = 1: must be from 2 to 100000"},
           {"section run --vertical 1 --out a.txt", "--out = a.txt: the name must end in"}}) {
    CAPTURE(arguments);
    const Outcome refused = place.porosph(arguments);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains(message));
  }
}

TEST_CASE("a grid is written with what it was asked for, or says what it needs") {
  const Workplace place;
  place.write("small.toml", small_case);
  REQUIRE(place.porosph("run small.toml --quiet --out run").status == 0);
  const Outcome usual = place.porosph("grid run");
  CHECK(usual.out == "run/grid.vti: 9 x 17 nodes, 153 of them in the soil, at 1 s\n");
  CHECK_THAT(text_of(place.folder() / "run/grid.vti"),
             Contains("type=\"ImageData\"") && Contains("EffectiveStress") && Contains("InSoil"));
  CHECK(place.porosph("grid run --spacing 0.1 --time 0.5 --field VonMisesStress --out g/fine.vti").status ==
        0);
  CHECK_THAT(text_of(place.folder() / "g/fine.vti"), Contains("VonMisesStress"));
  for (const auto& [arguments, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"--spacing -1", "--spacing = -1: must be > 0"},
           {"--spacing 1e-6", "is too large"},
           {"--out a.vtp", "must end in .vti"},
           {"--field Stress", "no field 'Stress'"},
           {"--time 9", "outside of the series"}}) {
    CAPTURE(arguments);
    const Outcome refused = place.porosph(std::string("grid run ") + arguments);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains(message));
  }
}
