#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "render/report/study.hpp"
#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using namespace porosph::render;
using Catch::Matchers::Contains;

namespace {

void put_file(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file) << content;
}

Study example() {
  return {.title = "Speed & <error>",
          .lead = "What a second buys",
          .sections =
              {{.heading = "Throughput",
                .paragraphs = {"Measured \"twice\""},
                .tables = {{.caption = "Rates", .rows = {{"n", "rate"}, {"10", "1.5 < 2"}}}},
                .pictures = {{.file = "rate.png", .description = "a curve", .caption = "Faster & faster"}}}},
          .files = {"rate.csv"},
          .command = "porosph bench --out 'a & b'"};
}

void put_files(const std::filesystem::path& folder) {
  put_file(folder / "rate.png", "not really a picture");
  put_file(folder / "rate.csv", "n,rate\n10,1.5\n");
}

}  // namespace

TEST_CASE("A study's page holds its text, escaped, its tables and its pictures") {
  const test::TemporaryFolder folder;
  put_files(folder.path());
  write_study(example(), folder.path());
  const std::string page = read_file(folder / "index.html");
  CHECK_THAT(page, Contains("<h1>Speed &amp; &lt;error&gt;</h1>"));
  CHECK_THAT(page, Contains("<p>Measured &quot;twice&quot;</p>"));
  CHECK_THAT(page, Contains("<td>1.5 &lt; 2</td>"));
  CHECK_THAT(page, Contains("<img src=\"rate.png\" alt=\"a curve\">"));
  CHECK_THAT(page, Contains("Faster &amp; faster"));
  CHECK_THAT(page, Contains("<a href=\"rate.csv\">rate.csv</a>"));
  CHECK_THAT(page, Contains("--out &#39;a &amp; b&#39;"));
}

TEST_CASE("A study comes back as it was written") {
  const test::TemporaryFolder folder;
  put_files(folder.path());
  CHECK(!is_study(folder.path()));
  write_study(example(), folder.path());
  CHECK(is_study(folder.path()));
  CHECK(to_json(read_study(folder.path())) == to_json(example()));
}

TEST_CASE("A report takes a study in with copies of its pictures") {
  const test::TemporaryFolder folder;
  const auto report = folder / "report";
  make_folder(report);
  put_files(folder.path());
  write_study(example(), folder.path());
  const std::string section = study_section(folder.path(), report, "study_1_");
  CHECK_THAT(section, Contains("<h2>Speed &amp; &lt;error&gt;</h2>"));
  CHECK_THAT(section, Contains("<img src=\"study_1_rate.png\""));
  CHECK(read_file(report / "study_1_rate.png") == "not really a picture");
}

TEST_CASE("A study without one of its files, or with a table of unequal rows, is refused") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(write_study(example(), folder.path()), Contains("rate.png"));
  CHECK(!std::filesystem::exists(folder / "index.html"));
  put_files(folder.path());

  Study study = example();
  study.sections[0].tables[0].rows[1].pop_back();
  CHECK_THROWS_WITH(write_study(study, folder.path()), Contains("'Rates'"));
  study = example();
  study.sections[0].pictures[0].file = "../rate.png";
  CHECK_THROWS_AS(write_study(study, folder.path()), ReadError);

  write_study(example(), folder.path());
  std::filesystem::remove(folder / "rate.csv");
  CHECK_THROWS_WITH(read_study(folder.path()), Contains("rate.csv"));
  put_file(folder / "study.json", R"({"title": "Speed"})");
  CHECK_THROWS_WITH(read_study(folder.path()), Contains("study.json") && Contains("lead"));
  put_file(folder / "study.json", R"({"title": )");
  CHECK_THROWS_AS(read_study(folder.path()), ReadError);
}
