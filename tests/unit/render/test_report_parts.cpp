#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "render/report/html.hpp"
#include "render/report/settings.hpp"
#include "render/report/threshold.hpp"
#include "render/run/material_points.hpp"
#include "render/run/norms.hpp"
#include "render/run/shown_field.hpp"
#include "solver/case/case_file.hpp"

using namespace porosph;
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
  CHECK(shown_label({"EffectiveStress", "YY"}, shown_unit("EffectiveStress", 1e5)) == "σ'yy [kPa]");
  CHECK(shown_label({"Displacement", "Y"}, shown_unit("Displacement", 0.02)) == "u_y [mm]");
  CHECK(shown_label({"Displacement", ""}, shown_unit("Displacement", 2)) == "|u| [m]");
  CHECK(shown_label({"Temperature", ""}, shown_unit("Temperature", 300)) == "Temperature");
  CHECK(shown_unit("TotalStress", 1).factor == 1e-3);
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
