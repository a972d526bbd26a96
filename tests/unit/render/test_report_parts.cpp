#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "render/report/html.hpp"
#include "render/report/report_tables.hpp"
#include "render/report/settings.hpp"
#include "render/run/history_lines.hpp"
#include "render/run/run_panel.hpp"
#include "render/run/shown_field.hpp"
#include "solver/case/case_file.hpp"
#include "vtk_io/finished_run/frame_pair.hpp"
#include "vtk_io/finished_run/material_points.hpp"
#include "vtk_io/finished_run/norms.hpp"
#include "vtk_io/run_folder/threshold.hpp"

using namespace porosph;
using namespace porosph::render;
using Catch::Matchers::Contains;

namespace {

/// Particles on a disturbed lattice over 2 m x 2 m that have moved by `shift`; Value is linear in where they
/// started.
Frame moved_frame(double spacing, const Point& shift, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> noise(-0.1 * spacing, 0.1 * spacing);
  Frame frame;
  std::vector<double> displacement, value;
  for (double y = spacing / 2; y < 2; y += spacing)
    for (double x = spacing / 2; x < 2; x += spacing) {
      const Point start(x + noise(random), y + noise(random));
      frame.points.insert(frame.points.end(), {start.x() + shift.x(), start.y() + shift.y(), 0});
      displacement.insert(displacement.end(), {shift.x(), shift.y(), 0});
      value.push_back(3 - 2 * start.x() + 5 * start.y());
    }
  frame.fields = {{"Displacement", {"X", "Y", "Z"}, displacement}, {"Value", {}, value}};
  return frame;
}

FinishedRun run_with(double spacing) {
  FinishedRun run;
  run.name = "run";
  run.scene.emplace();
  run.scene->particles.spacing = spacing;
  return run;
}

}  // namespace

TEST_CASE("a selection is a field and perhaps a component") {
  CHECK(parse_selection("EffectiveStress:YY").text() == "EffectiveStress_YY");
  CHECK(parse_selection("PorePressure").text() == "PorePressure");
  for (const char* wrong : {"", ":YY", "EffectiveStress:", "a:b:c"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(parse_selection(wrong), Contains("NAME:COMPONENT"));
  }
}

TEST_CASE("values are a component, a scalar or a magnitude") {
  Frame frame;
  frame.points.resize(6);
  frame.fields = {{"Velocity", {"X", "Y", "Z"}, std::vector<double>{3, 4, 0, 0, -2, 0}},
                  {"SoilId", {}, std::vector<std::int32_t>{0, 7}}};
  CHECK(values_of(frame, {"Velocity", ""}) == std::vector<double>{5, 2});
  CHECK(values_of(frame, {"Velocity", "Y"}) == std::vector<double>{4, -2});
  CHECK(values_of(frame, {"SoilId", ""}) == std::vector<double>{0, 7});
  CHECK_THROWS_WITH(values_of(frame, {"Speed", ""}), Contains("it has Velocity, SoilId"));
  CHECK_THROWS_WITH(values_of(frame, {"Velocity", "YY"}), Contains("it has X, Y, Z"));
}

TEST_CASE("people read stress in kPa and small displacements in mm") {
  CHECK(shown_label({"EffectiveStress", "YY"}, shown_unit("EffectiveStress", 1e5)) == "σ'_{yy} [kPa]");
  CHECK(shown_label({"Displacement", "Y"}, shown_unit("Displacement", 0.02)) == "u_{y} [mm]");
  CHECK(shown_label({"Displacement", ""}, shown_unit("Displacement", 2)) == "|u| [m]");
  CHECK(shown_label({"Temperature", ""}, shown_unit("Temperature", 300)) == "Temperature");
  CHECK(shown_unit("TotalStress", 1).factor == 1e-3);
  CHECK(shown_name({"EffectiveStress", "YY"}) == "Effective vertical stress");
  CHECK(name_in_sentence({"EffectiveStress", "YY"}) == "effective vertical stress");
  CHECK(name_in_sentence({"Density", ""}) == "density");
  CHECK(name_in_sentence({"MyField", ""}) == "MyField");
}

TEST_CASE("runs of different particles are compared exactly where values are linear") {
  const Frame a = moved_frame(0.2, {0.3, -0.1}, 1), b = moved_frame(0.13, {-0.2, 0.4}, 2);
  const MaterialPoints points = common_points(run_with(0.2), a, run_with(0.13), b);
  CHECK_FALSE(points.particle_by_particle);
  CHECK(points.at.size() == 100);  // the coarser run's
  const auto values_a = points.sample_a(values_of(a, {"Value", ""})),
             values_b = points.sample_b(values_of(b, {"Value", ""}));
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    const double exact = 3 - 2 * points.at[i].x() + 5 * points.at[i].y();
    CHECK(values_a[i] == Approx(exact).margin(1e-10));
    CHECK(values_b[i] == Approx(exact).margin(1e-10));
  }
}

TEST_CASE("runs of the same particles are compared one by one, in whatever order they are") {
  Frame a = moved_frame(0.5, {0.1, 0}, 3), b = moved_frame(0.5, {0, 0.2}, 3);
  const std::size_t count = a.points.size() / 3;
  std::vector<std::int32_t> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<std::int32_t>(i);
  a.fields.push_back({"ParticleId", {}, ids});
  b.fields.push_back({"ParticleId", {}, ids});
  auto& id = std::get<std::vector<std::int32_t>>(b.fields[2].values);
  auto& value = std::get<std::vector<double>>(b.fields[1].values);
  std::swap(id[0], id[5]);
  std::swap(value[0], value[5]);
  for (std::size_t c = 0; c < 3; ++c) std::swap(b.points[c], b.points[15 + c]);
  const MaterialPoints points = common_points(run_with(0.5), a, run_with(0.5), b);
  CHECK(points.particle_by_particle);
  CHECK(points.sample_a(values_of(a, {"Value", ""})) == points.sample_b(values_of(b, {"Value", ""})));
}

TEST_CASE("norms weigh with volume, tell where, and know a reference of zero") {
  const std::vector<Point> at = {{0, 0}, {1, 0}, {2, 0}};
  const FieldNorms n = norms({"Value", ""}, {1, 2, 5}, {1, 1, 2}, at, {1, 2, 3}, 2);
  CHECK(n.relative_l2 == Approx(std::sqrt((2 * 1 + 3 * 9) / (1. + 2 + 12))));
  CHECK(n.max_abs == 3);
  CHECK(n.where == at[2]);
  CHECK(std::isnan(norms({"Value", ""}, {1, 2, 5}, {0, 1e-12, 0}, at, {1, 1, 1}, 2).relative_l2));
  CHECK(std::isnan(norms({"Value", ""}, {1, NAN, 5}, {1, 1, 2}, at, {1, 1, 1}, 2).max_abs));
}

TEST_CASE("a threshold says what counts as failure") {
  const auto summary =
      nlohmann::ordered_json::parse(R"({"time": 2, "errors": {"U": {"relative_l2": 0.5}}, "ratio": null,
                                                         "title": "x"})");
  CHECK(check(parse_threshold("time>1.9"), summary).failed);
  CHECK_FALSE(check(parse_threshold("time>2"), summary).failed);
  CHECK(check(parse_threshold("time>=2"), summary).failed);
  CHECK(check(parse_threshold("time < 2.5"), summary).failed);
  CHECK_FALSE(check(parse_threshold("time<=1.5"), summary).failed);
  CHECK(check(parse_threshold("errors.U.relative_l2>0.4"), summary).failed);
  CHECK(check(parse_threshold("ratio>1"), summary).failed);  // null: it was not finite
  CHECK(check(parse_threshold("ratio<1"), summary).failed);
  CHECK_THROWS_WITH(check(parse_threshold("errors.V.relative_l2>1"), summary),
                    Contains("no 'V'; here it has U"));
  CHECK_THROWS_WITH(check(parse_threshold("title>1"), summary), Contains("not a number"));
  for (const char* wrong : {"time", "time>", ">1", "time>1x", "time>nan", "time=1"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(parse_threshold(wrong), Contains("PATH>NUMBER"));
  }
}

TEST_CASE("text cannot become part of the page") {
  CHECK(html::escaped("<b a=\"1\" c='2'>&") == "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;");
  CHECK_THAT(html::table({{"<th>", "v"}, {"a", "<script>"}}),
             !Contains("<script") && Contains("&lt;script&gt;"));
  CHECK_THAT(html::table({{"Probe"}, {"A: σ'_{yy} <b>"}}), Contains("σ&#39;<sub>yy</sub> &lt;b&gt;"));
  CHECK_THAT(html::figure("a.png", "\"x\"", "<i>"), Contains("alt=\"&quot;x&quot;\"") && !Contains("<i>"));
}

TEST_CASE("settings that differ are found by their keys") {
  const Case plain = read_case(POROSPH_SOURCE_DIR "/cases/foundation.toml");
  const Case changed = read_case(POROSPH_SOURCE_DIR "/cases/foundation.toml",
                                 {"soil.0.youngs_modulus=2e7", "formulation.motion=proposed"});
  CHECK(differing_settings({plain, plain}).empty());
  const auto differences = differing_settings({plain, changed});
  const auto named = [&](const std::string& key) {
    return std::find_if(differences.begin(), differences.end(), [&](const auto& d) { return d.key == key; });
  };
  REQUIRE(named("soil.0.youngs_modulus") != differences.end());
  CHECK(std::stod(named("soil.0.youngs_modulus")->values[1]) == 2e7);
  REQUIRE(named("formulation.motion") != differences.end());
  CHECK(named("particles.spacing") == differences.end());
}

TEST_CASE("settings are shown as people write them") {
  const Case a = read_case(POROSPH_SOURCE_DIR "/cases/foundation.toml"),
             b = read_case(POROSPH_SOURCE_DIR "/cases/foundation.toml",
                           {"time.courant=0.1", "water.level=15.06", "loading.damping=0.06"});
  std::map<std::string, std::string> values;
  for (const DifferingSetting& d : differing_settings({a, b})) values[d.key] = d.values[1];
  CHECK(values["time.courant"] == "0.1");
  CHECK(values["water.level"] == "15.06");
  CHECK(values["loading.damping"] == "0.06");
}

namespace {

FinishedRun run_of(const std::string& folder, const std::vector<double>& times, RunStatus status,
                   double time_step = 1e-3) {
  FinishedRun run;
  run.folder = folder;
  run.name = folder;
  for (const double time : times) run.series.frames.push_back({.time = time, .file = ""});
  run.summary.emplace();
  run.summary->status = status;
  run.summary->time = times.back();
  run.summary->time_step = time_step;
  return run;
}

}  // namespace

TEST_CASE(
    "the table of energy has shares of what each run released, and is left out where none has a budget") {
  FinishedRun elastic, flowing;
  elastic.summary.emplace(), flowing.summary.emplace();
  const std::vector<LoadedRun> runs = {{elastic, "elastic", {}}, {flowing, "flows", {}}};
  CHECK(energy_table(runs).size() == 1);
  flowing.summary->energy = {.released = 8, .kinetic = 1, .plastic = 5, .control = 1.5, .unaccounted = 0.5};
  const Rows rows = energy_table(runs);
  CHECK(rows[0] == std::vector<std::string>{"Energy", "elastic", "flows"});
  CHECK(rows[1] == std::vector<std::string>{"released [J/m]", "–", "8"});
  CHECK(rows[2] == std::vector<std::string>{"kinetic now", "–", "12.50 %"});
  CHECK(rows[4] == std::vector<std::string>{"dissipated by the soil", "–", "62.50 %"});
  CHECK(rows.back() == std::vector<std::string>{"unaccounted for", "–", "6.25 %"});
  CHECK(markdown({{"a", "b|c"}, {"1", "2"}}) == "| a | b\\|c |\n| --- | --- |\n| 1 | 2 |\n\n");
}

TEST_CASE("states of two times are not compared") {
  const FinishedRun broken = run_of("broken", {0, 0.0919}, RunStatus::unstable),
                    whole = run_of("whole", {0, 0.0502, 0.1002}, RunStatus::completed),
                    fitting = run_of("fitting", {0, 0.0502, 0.0925, 0.1002}, RunStatus::completed),
                    rest = run_of("rest", {0, 3}, RunStatus::equilibrium);
  CHECK_THROWS_WITH(require_fair(broken, whole, last_frames(broken, whole)),
                    Contains("broken would be compared at 0.0919 s with whole at 0.1002 s"));
  CHECK_THROWS_WITH(common_frames(broken, whole), Contains("output.times=[0.0919]"));
  const FramePair common = common_frames(fitting, broken);
  CHECK(common.a == 2);
  CHECK(common.b == 1);
  CHECK(is_fair(fitting, broken, common));
  CHECK(common_frames(whole, fitting).a == 2);
  CHECK(is_fair(rest, whole, last_frames(rest, whole)));
  CHECK_FALSE(is_fair(rest, whole, {0, 2}));  // not at rest yet
}

TEST_CASE("runs are called by their labels") {
  std::vector<FinishedRun> runs = {run_of("a/x", {1}, RunStatus::completed),
                                   run_of("b/x", {1}, RunStatus::completed)};
  runs[0].name = runs[1].name = "x";
  CHECK(run_labels(runs) == std::vector<std::string>{"a/x", "b/x"});
  CHECK_THROWS_WITH(set_labels(runs, {"one"}), Contains("1 time for 2 runs"));
  set_labels(runs, {"one", "two"});
  CHECK(run_labels(runs) == std::vector<std::string>{"one", "two"});
}

TEST_CASE("a history says where its run ended") {
  ChartSeries line{.label = "run", .x = {0, 1}, .y = {0, 1}};
  mark_end(line, run_of("run", {0, 0.0919118}, RunStatus::unstable));
  CHECK(line.label == "run, unstable at 0.0919 s");
  CHECK(line.end == LineEnd::broken);
  ChartSeries long_line{.label = "run", .x = {0, 1}, .y = {0, 1}};
  mark_end(long_line, run_of("run", {0, 358560}, RunStatus::unstable));
  CHECK(long_line.label == "run, unstable at 4.15 d");
}

TEST_CASE("times have as many digits as distinguish them") {
  CHECK(time_text(0.0919118) == "t = 0.0919 s");
  CHECK(time_text(100.25) == "t = 100.2 s");
  CHECK(time_text(216000) == "t = 2 d 12 h");
  CHECK(time_text(302402.5) == "t = 3 d 12 h 2.5 s");
  CHECK(time_text(302402.50000001) == time_text(302402.5));
  CHECK(time_text(3599.9999) == "t = 1 h");
  CHECK(time_text(3599.996) == "t = 59 min 59.996 s");
}

TEST_CASE("a subtitle does not repeat the title") {
  FinishedRun run = run_of("x", {0, 0.5}, RunStatus::unstable);
  run.scene.emplace();
  run.scene->formulation.motion = Motion::proposed;
  run.scene->formulation.kernel_correction = false;
  run.scene->loading.damping = 0;
  run.scene->loading.adaptive_damping = false;
  CHECK(panel_subtitle(run, 0, "x") == "t = 0 s, proposed, without kernel correction, undamped");
  CHECK(panel_subtitle(run, 0.5, "proposed, undamped") == "t = 0.5 s, unstable, without kernel correction");
}

TEST_CASE("soils are categories by their names") {
  Case scene;
  scene.soils.resize(2);
  scene.soils[0].name = "clay";
  scene.soils[1].name = "sand";
  const ColourScale scale = scale_of({"SoilId", ""}, {"", 1}, scene, std::nullopt);
  CHECK(scale.categories == std::vector<std::string>{"clay", "sand"});
  const std::vector<double> values = {0, 1, 0};
  const auto colours = colours_of(values, fix_scale(scale, values));
  CHECK(colours[0] == colours[2]);
  CHECK(colours[0] != colours[1]);
}

TEST_CASE("with the soil's deformation drawn larger, its outline and probes move along") {
  Case scene;
  scene.particles.spacing = 0.5;
  scene.soils.resize(1);
  scene.soils[0].polygon = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  ContourPanel panel;
  panel.scenery = scenery_of(scene);
  panel.scenery.probes = {{"A", {1, 1}}};
  std::vector<Point> starts, displacements;
  for (double y = 0.25; y < 2; y += 0.5)
    for (double x = 0.25; x < 4; x += 0.5) {
      starts.push_back({x, y});
      displacements.push_back({0.01 * y, -0.02 * y});  // linear: exact to the outline
    }
  deform_surroundings(panel, scene, starts, displacements, 50);
  CHECK((panel.scenery.probes[0].position - Point(1.5, 0)).norm() < 1e-9);
  double lowest = 1e9, right = 0;
  for (const Point& corner : panel.scenery.soils[0].polygon)
    lowest = std::min(lowest, corner.y()), right = std::max(right, corner.x());
  CHECK(lowest == Approx(0).margin(1e-9));  // y - 50 * 0.02 y: the whole body is flat
  CHECK(right == Approx(5));
  REQUIRE(panel.particles.cells.size() == starts.size());
  const double half = 0.5 * 1.03 * 0.5;  // cells overlap a little
  const Point corner = panel.particles.cells[0][2];
  CHECK((corner - Point(half + 0.5 * half, 0)).norm() < 1e-9);
}
