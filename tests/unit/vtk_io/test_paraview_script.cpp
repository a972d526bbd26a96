#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/unit/vtk_io/example_frame.hpp"
#include "vtk_io/paraview_script.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

/// What a script says of its run: one line that is JSON as well as Python.
nlohmann::json run_of(const std::string& script) {
  const std::string mark = "\nRUN = ";
  const auto begin = script.find(mark) + mark.size();
  return nlohmann::json::parse(script.substr(begin, script.find('\n', begin) - begin));
}

}  // namespace

TEST_CASE("the script colours by the vertical effective stress") {
  const auto run = run_of(paraview_script("/a/b", "particles.pvd", example_frame()));
  CHECK(run["series"] == "particles.pvd");
  CHECK(run["folder"] == "/a/b");
  CHECK(run["field"] == "EffectiveStress");
  CHECK(run["component"] == "YY");
  CHECK(run["unit"] == "kPa");
  CHECK(run["factor"] == 1e-3);
  CHECK(run["smoothing_length"] == 0);  // unknown
}

TEST_CASE("without effective stress the script colours by the first field, or by none") {
  auto frame = example_frame();
  frame.fields = {field("PorePressure", {}, 123), field("Velocity", {"X", "Y", "Z"}, 123)};
  const auto run = run_of(paraview_script("", "a", frame));
  CHECK(run["field"] == "PorePressure");
  CHECK(run["component"] == "");
  frame.fields.erase(frame.fields.begin());
  CHECK(run_of(paraview_script("", "a", frame))["component"] == "X");
  frame.fields.clear();
  CHECK(run_of(paraview_script("", "a", frame))["field"] == "");
}

TEST_CASE("the script knows probes and water") {
  ScriptScene scene;
  scene.title = "Dam";
  scene.spacing = 0.2;
  scene.boundary = true;
  scene.probes = {{"A", {1, 2}}};
  scene.water.stretches = {{-never, 3, 4}, {3, never, 5}};
  const auto run = run_of(paraview_script("", "a", example_frame(), scene));
  CHECK(run["title"] == "Dam");
  CHECK(run["spacing"] == 0.2);
  CHECK(run["boundary"] == 1);
  CHECK(run["probes"] == nlohmann::json::parse(R"([["A", 1.0, 2.0]])"));
  REQUIRE(run["water"].size() == 2);
  CHECK(run["water"][0][0] < -1e9);  // everywhere: JSON has no infinity
  CHECK(run["water"][1][2] == 5);
  CHECK(run["level_over_time"].empty());
  scene.soils = {{.name = "s", .polygon = {{0, 0}, {3, 0}, {0, 2}}, .holes = {{{1, 1}}}}};
  scene.boundaries = {{BoundaryKind::fixed, {0, 0}, {3, 0}}};
  const auto drawn = run_of(paraview_script("", "a", example_frame(), scene));
  CHECK(drawn["outlines"] == nlohmann::json::parse("[[0.0, 0.0, 3.0, 0.0, 0.0, 2.0], [1.0, 1.0]]"));
  CHECK(drawn["supports"] == nlohmann::json::parse(R"([["fixed", 0.0, 0.0, 3.0, 0.0]])"));

  scene.water = {.stretches = {{-never, never, 1}}, .level_over_time = {{0, 1}, {2, 3}}};
  const auto rising = run_of(paraview_script("", "a", example_frame(), scene));
  CHECK(rising["water"].empty());
  CHECK(rising["level_over_time"] == nlohmann::json::parse("[[0.0, 1.0], [2.0, 3.0]]"));
}

TEST_CASE("names are quoted as Python text") {
  const auto script = paraview_script("/it's \"here\"\\\n{x}/ü", "a.pvd", example_frame());
  CHECK_THAT(script, Contains(R"("/it's \"here\"\\\n{x}/ü")"));
  CHECK(run_of(script)["folder"] == "/it's \"here\"\\\n{x}/ü");
}

TEST_CASE("a script of two runs names their folders") {
  CHECK_THAT(paraview_comparison_script("/runs/c", "../a", "../b b"),
             Contains("\nFOLDERS = [\"../a\",\"../b b\"]\n") && Contains("\nWRITTEN_IN = \"/runs/c\" "));
  CHECK_THAT(paraview_comparison_script("/", ".", ""), Contains("\nFOLDERS = [\".\",\"\"]\n"));
}

TEST_CASE("a script stands alone") {
  for (const std::string& script :
       {paraview_script("/a", "a.pvd", example_frame()), paraview_comparison_script("/a", ".", "")}) {
    CHECK_THAT(script, !Contains("porosph_common") && Contains("\ndef show_run(") && Contains("\nfinish("));
  }
}
