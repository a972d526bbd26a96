// From a case to pictures, comparison and report, on a case of a few particles.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/porosph.hpp"
#include "tests/unit/render/image.hpp"

using namespace porosph;
using namespace porosph::render;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const Workplace& computed() {
  static const Workplace place;
  static const bool done = [] {
    place.write("small.toml", small_case);
    REQUIRE(place.porosph("run small.toml --quiet --out consistent").status == 0);
    REQUIRE(place.porosph("run small.toml --quiet --out proposed --set formulation.motion=proposed").status ==
            0);
    REQUIRE(place.porosph("run small.toml --quiet --out finer --set particles.spacing=0.25").status == 0);
    REQUIRE(place.porosph("run small.toml --quiet --out shorter --set time.end=0.5").status == 0);
    REQUIRE(
        place.porosph("run small.toml --quiet --out other --set 'soil.0.polygon=[[0,0],[2,0],[2,3],[0,3]]'")
            .status == 0);
    REQUIRE(place.porosph("fem small.toml --out fem").status == 0);
    return true;
  }();
  REQUIRE(done);
  return place;
}

bool is_png(const fs::path& file) {
  return text_of(file).starts_with("\x89PNG") && fs::file_size(file) > 5000;
}

nlohmann::json json_of(const fs::path& file) { return nlohmann::json::parse(text_of(file)); }

}  // namespace

TEST_CASE("render draws a field and names what there is when asked for another") {
  const Workplace& place = computed();
  CHECK(place.porosph("render consistent --field EffectiveStress:YY").out ==
        "consistent/EffectiveStress_YY.png\n");
  CHECK(is_png(place.folder() / "consistent/EffectiveStress_YY.png"));
  CHECK(place.porosph("render consistent/particles.pvd --field Displacement --deform 10 --out deep/u.png")
            .status == 0);
  CHECK(is_png(place.folder() / "deep/u.png"));
  const auto [arguments, message] = GENERATE(table<std::string, std::string>({
      {"--field Stress", "it has Displacement, Velocity, EffectiveStress"},
      {"--field EffectiveStress", "choose a component"},
      {"--field EffectiveStress:AB", "it has XX, YY, ZZ, XY, YZ, XZ"},
      {"--field PorePressure:X", "is a scalar"},
      {"--field PorePressure --time 5", "from 0 s to 1 s"},
      {"--field PorePressure --time soon", "'soon' is not a number"},
      {"--field PorePressure --range 2,1", "LOW must be below HIGH"},
      {"--field PorePressure --map jet", "viridis, cividis or cool_warm"},
      {"--field PorePressure --width 10", "from 200 to 8000"},
      {"--field PorePressure --out p.jpg", ".png"},
  }));
  CAPTURE(arguments);
  const Outcome outcome = place.porosph("render consistent " + arguments);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(message));
}

TEST_CASE("render draws every frame in one range") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("render shorter --field PorePressure --time all --out frames/p.png").status == 0);
  for (const char* file : {"p_000000.png", "p_000005.png"}) CHECK(is_png(place.folder() / "frames" / file));
  CHECK_FALSE(fs::exists(place.folder() / "frames/p_000006.png"));
}

TEST_CASE("render draws several times as panels of one picture, in one range") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("render shorter --field PorePressure --out one.png").status == 0);
  REQUIRE(place.porosph("render shorter --field PorePressure --time 0 --time last --out two.png").status ==
          0);
  const Image one(place.folder() / "one.png"), two(place.folder() / "two.png");
  CHECK(std::max(two.width() - one.width(), two.height() - one.height()) > 100);
  CHECK_THAT(place.porosph("render shorter --field PorePressure --time all --time 0").err,
             Contains("--time all is every frame already"));
}

TEST_CASE("pictures are the same for the same input") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("report consistent proposed --instants 3 --out report_1").status == 0);
  REQUIRE(place.porosph("report consistent proposed --instants 3 --out report_2").status == 0);
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(place.folder() / "report_1")) {
    if (entry.path().extension() != ".png") continue;
    ++pictures;
    CAPTURE(entry.path().filename());
    CHECK(text_of(entry.path()) == text_of(place.folder() / "report_2" / entry.path().filename()));
  }
  // case, three fields of two runs, differences, slider, section, history, settlement, developments, players
  CHECK(pictures == 2 + 3 * 3 + 2 + 2 + 2 + 2 + 3 + 2 + 2 * 3);
}

TEST_CASE("compare finds a run equal to itself, and the known distance of others") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("compare consistent consistent --out same").status == 0);
  const auto same = json_of(place.folder() / "same/comparison.json");
  CHECK(same["particle_by_particle"] == true);
  CHECK(same["points"] == 32);
  CHECK(same["a_against_b"]["EffectiveStress_YY"]["relative_l2"] == 0.0);
  CHECK(same["a_against_b"]["EffectiveStress_XY"]["relative_l2"].is_null());  // zero in a column

  REQUIRE(place.porosph("compare proposed consistent --out different --fem fem").status == 0);
  const auto different = json_of(place.folder() / "different/comparison.json");
  // eq. (24) is off by gamma' dx / 2 = 2.55 kPa over the depth, 11 % of this column, and by more next to the
  // bottom
  CHECK(different["a_against_fem"]["EffectiveStress_YY"]["relative_l2"].get<double>() ==
        Approx(0.14).margin(0.04));
  CHECK(different["b_against_fem"]["EffectiveStress_YY"]["relative_l2"] < 0.05);
  CHECK(different["a_against_fem"]["EffectiveStress_YY"]["relative_l2"] >
        different["b_against_fem"]["EffectiveStress_YY"]["relative_l2"]);
  CHECK(is_png(place.folder() / "different/TotalStress_YY.png"));
  CHECK(is_png(place.folder() / "different/history.png"));
  CHECK_THAT(text_of(place.folder() / "different/comparison.csv"),
             Contains("proposed,consistent,EffectiveStress_YY,") && Contains("consistent,finite elements,"));
}

TEST_CASE("compare interpolates between runs of different spacing") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("compare finer consistent --out spacing").status == 0);
  const auto json = json_of(place.folder() / "spacing/comparison.json");
  CHECK(json["particle_by_particle"] == false);
  CHECK(json["points"] == 32);
  CHECK(json["a_against_b"]["EffectiveStress_YY"]["relative_l2"] < 0.05);
  CHECK(json["a_against_b"]["Displacement_Y"]["relative_l2"] < 0.02);
}

TEST_CASE("the key label names a run, where the command line does not") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("run small.toml --quiet --out named --set \"label='as \\\"built\\\"'\"").status == 0);
  CHECK_THAT(place.porosph("compare named shorter --time common --out by_label").out,
             Contains("as \"built\" at 0.5 s and shorter at 0.5 s"));
  CHECK_THAT(place.porosph("compare named shorter --time common --label a --label b --out by_option").out,
             Contains("a at 0.5 s and b at 0.5 s"));
  CHECK_THAT(place.porosph("compare named named --out alike").out, Contains("named at 1 s and named at 1 s"));
  REQUIRE(place.porosph("report named --out report_named").status == 0);
  CHECK_THAT(text_of(place.folder() / "report_named/index.html"), Contains("as &quot;built&quot;"));
}

TEST_CASE("compare refuses what cannot be compared") {
  const Workplace& place = computed();
  const Outcome time = place.porosph("compare consistent shorter --out no");
  CHECK(time.status == 2);
  CHECK_THAT(time.err, Contains("consistent would be compared at 1 s with shorter at 0.5 s") &&
                           Contains("--time common"));
  CHECK(place.porosph("compare consistent shorter --time common --out yes").status == 0);
  const Outcome different = place.porosph(
      "compare consistent shorter --allow-different-times --label one --label 'two, shorter' --out "
      "different_times");
  CHECK(different.status == 0);
  CHECK_THAT(different.out, Contains("one at 1 s and two, shorter at 0.5 s, times that differ") &&
                                Contains("Effective vertical stress"));
  CHECK_THAT(text_of(place.folder() / "different_times/comparison.csv"),
             Contains("one,\"two, shorter\",EffectiveStress_YY,") && Contains(",1,0.5\n"));
  const Outcome body = place.porosph("compare consistent other --out no");
  CHECK(body.status == 2);
  CHECK_THAT(body.err, Contains("outlines of soil 'sand' differ"));
  const Outcome reference = place.porosph("compare other other --fem fem --out no");
  CHECK(reference.status == 2);
  CHECK_THAT(reference.err, Contains("the outline of soil 'sand' differs"));
  CHECK_FALSE(fs::exists(place.folder() / "no"));
}

TEST_CASE("the report is a page of escaped text whose pictures are all there") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("report consistent proposed --fem fem --instants 4 --out page").status == 0);
  const std::string page = text_of(place.folder() / "page/index.html");
  CHECK_THAT(page, Contains("Small &lt;column&gt; &amp; &quot;water&quot;") && !Contains("<column>") &&
                       !Contains("http"));
  CHECK(page.find("<script>") == page.rfind("<script>"));  // ours alone
  CHECK_THAT(page, Contains("prefers-color-scheme: dark") && Contains("@media print"));
  CHECK_THAT(page, Contains("porosph run consistent/case.toml --out consistent"));
  const std::regex image("<img src=\"([^\"]+)\"");
  int images = 0;
  for (std::sregex_iterator i(page.begin(), page.end(), image), end; i != end; ++i, ++images) {
    CAPTURE((*i)[1].str());
    CHECK(is_png(place.folder() / "page" / (*i)[1].str()));
  }
  // as above, with a panel of finite elements in each field, three differences, and four stresses of the
  // probe
  CHECK(images == 2 + 3 * 4 + 4 + 2 + 2 + 2 + 3 + 5 + 2 + 2 * 4);
}

TEST_CASE("a report draws the fields, ranges, sections and instants that are asked for") {
  const Workplace& place = computed();
  REQUIRE(place
              .porosph("report consistent --field StressRatio --field PorePressure --range 0,3 --range -60,0 "
                       "--level 1 --level 2 --instants 0 --out asked")
              .status == 0);
  const std::string page = text_of(place.folder() / "asked/index.html");
  CHECK_THAT(page, Contains("contours_StressRatio.png") && Contains("contours_PorePressure.png") &&
                       Contains("sections_2.png") && !Contains("contours_TotalStress") &&
                       !Contains("class=\"player\"") && Contains("development_consistent.png"));
  CHECK_THAT(text_of(place.folder() / "asked/sections.csv"), Contains("StressRatio"));
  for (const auto& [arguments, message] : {std::pair{"--range 0,1", "1 --range for 0 --field"},
                                           {"--field Nothing", "no field 'Nothing'"},
                                           {"--vertical 1 --level 1", "do not go together"},
                                           {"--instants -1", "must be from 0 to 1000"}}) {
    CAPTURE(arguments);
    const Outcome refused = place.porosph(std::string("report consistent --out no ") + arguments);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains(message));
  }
}

TEST_CASE("history draws stress, settlement, stress paths and Mohr's circle at probes") {
  const Workplace& place = computed();
  for (const char* show : {"stress", "settlement", "pq", "st", "mohr"}) {
    CAPTURE(show);
    const Outcome drawn = place.porosph(std::string("history consistent proposed --show ") + show);
    CHECK(drawn.status == 0);
    CHECK(is_png(place.folder() / ("consistent/history_" + std::string(show) + ".png")));
  }
  CHECK(place.porosph("history consistent --show st --probe A --out paths/a.svg").status == 0);
  CHECK_THAT(text_of(place.folder() / "paths/a.svg"), Contains("<svg"));
  CHECK_THAT(place.porosph("history consistent --probe B").err, Contains("--probe = B: consistent has A"));
  CHECK_THAT(place.porosph("history consistent --show pg").err,
             Contains("must be stress, settlement, water, pq"));
}

TEST_CASE("a report has contents, and may be a single file with a summary beside it") {
  const Workplace& place = computed();
  REQUIRE(place.porosph("report consistent proposed --fem fem --instants 4 --out linked").status == 0);
  const std::string linked = text_of(place.folder() / "linked/index.html");
  CHECK_THAT(linked, Contains("<li><a href=\"#sections\">Sections</a></li>") &&
                         Contains("<section id=\"sections\">") &&
                         Contains("<a href=\"sections.png\"><img src=\"sections.png\"") &&
                         Contains("by Porosph "));
  REQUIRE(place.shell("SOURCE_DATE_EPOCH=0 '" POROSPH_PROGRAM
                      "' report consistent proposed --fem fem --instants 4 --out single --single-file "
                      "--summary summary.md "
                      "--fail-if 'time>1e9'") == 0);
  const std::string page = text_of(place.folder() / "single/index.html");
  CHECK_THAT(page, Contains("Made 1970-01-01 00:00 UTC by Porosph") && !Contains(".png\""));
  const std::regex image("<img src=\"data:image/png;base64,iVBORw0KGgo");
  CHECK(std::distance(std::sregex_iterator(page.begin(), page.end(), image), {}) == 42);
  for (const auto& entry : fs::directory_iterator(place.folder() / "single"))
    CHECK(entry.path().extension() != ".png");
  const std::string summary = text_of(place.folder() / "summary.md");
  CHECK_THAT(summary, Contains("## Small &lt;column&gt;") && Contains("| Run | consistent | proposed |") &&
                          Contains("### Thresholds") && Contains("### Differences from finite elements"));
}

TEST_CASE("the report shows studies as sections") {
  const Workplace& place = computed();
  fs::create_directories(place.folder() / "study");
  place.write("study/study.json", R"({"title": "Speed", "lead": "", "files": [], "command": "porosph bench",
    "sections": [{"heading": "All", "paragraphs": ["fast"], "tables": [],
                  "pictures": [{"file": "a.png", "description": "", "caption": "A"}]}]})");
  const Outcome missing = place.porosph("report consistent study --out with_study");
  CHECK(missing.status == 4);
  CHECK_THAT(missing.err, Contains("study/a.png"));
  place.write("study/a.png", "a picture");
  REQUIRE(place.porosph("report consistent study --out with_study").status == 0);
  CHECK_THAT(text_of(place.folder() / "with_study/index.html"),
             Contains("<h2>Speed</h2>") && Contains("study_1_a.png"));
  CHECK(json_of(place.folder() / "with_study/report.json")["studies"][0]["title"] == "Speed");
  const Outcome alone = place.porosph("report study --out no");
  CHECK(alone.status == 2);
  CHECK_THAT(alone.err, Contains("study/index.html"));
}

TEST_CASE("a failed threshold ends with status 1 and is reported") {
  const Workplace& place = computed();
  const std::string path = "errors.EffectiveStress_YY.relative_l2";
  CHECK(place.porosph("report consistent --out r --fail-if '" + path + ">0.5'").status == 0);
  const Outcome failed = place.porosph("report consistent --out r --fail-if '" + path + ">1e-9'");
  CHECK(failed.status == 1);
  CHECK_THAT(failed.err, Contains("threshold failed: consistent: " + path + ">1e-9"));
  CHECK(json_of(place.folder() / "r/report.json")["thresholds"][0]["failed"] == true);
  const Outcome unknown = place.porosph("report consistent --out r --fail-if 'errors.Stress.relative_l2>1'");
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.err, Contains("no 'Stress'") && Contains("EffectiveStress_YY"));
}
