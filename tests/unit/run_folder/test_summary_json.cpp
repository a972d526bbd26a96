#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/run_folder/summary_json.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Summary example() {
  Summary summary;
  summary.status = RunStatus::equilibrium;
  summary.message = "\"quoted\" and\nbroken";
  summary.title = "Böschung";
  summary.formulation = "proposed";
  summary.kernel_correction = false;
  summary.particles = 3750;
  summary.steps = 123456789012;
  summary.time = 0.1;
  summary.time_step = 1.0 / 3;
  summary.threads = 4;
  summary.wall_seconds = 12.5;
  summary.stepping_seconds = 11.25;
  summary.particle_steps_per_second = 1e7;
  summary.peak_memory_bytes = 1LL << 40;
  summary.scaled_inertia = {{"gravel", 7.5}};
  summary.unbalanced_force_ratio = 1e-5;
  summary.energy_growth = -0.25;
  summary.probes["A"] = {7.5, 5.0, {{"EffectiveStress_YY", -5e4}, {"PorePressure", -9.81e4}}};
  summary.errors["EffectiveStress_YY"] = {0.01, 123.0};
  summary.warnings = {"time.courant = 1.2: runs break down above 1"};
  summary.skipped["water"] = "the scene has none";
  return summary;
}

json written(const TemporaryFolder& folder, const Summary& summary) {
  write_summary(folder / "summary.json", summary);
  return json::parse(content(folder / "summary.json"));
}

Summary read_again(const TemporaryFolder& folder, const Summary& summary) {
  write_summary(folder / "summary.json", summary);
  return read_summary(folder / "summary.json");
}

}  // namespace

TEST_CASE("a summary has the keys that other programs rely on") {
  const TemporaryFolder folder;
  const auto expected = json::parse(R"({
    "title": "Böschung", "status": "equilibrium", "message": "\"quoted\" and\nbroken",
    "particles": 3750, "steps": 123456789012, "time": 0.1, "time_step": 0.3333333333333333, "threads": 4,
    "wall_seconds": 12.5, "stepping_seconds": 11.25, "particle_steps_per_second": 1e7,
    "peak_memory_bytes": 1099511627776, "scaled_inertia": {"gravel": 7.5}, "formulation": "proposed", "kernel_correction": false,
    "unbalanced_force_ratio": 1e-5, "energy_growth": -0.25,
    "probes": {"A": {"position": [7.5, 5.0], "values": {"EffectiveStress_YY": -5e4, "PorePressure": -9.81e4}}},
    "errors": {"EffectiveStress_YY": {"relative_l2": 0.01, "max_abs": 123.0}},
    "warnings": ["time.courant = 1.2: runs break down above 1"],
    "skipped": {"water": "the scene has none"}})");
  CHECK(written(folder, example()) == expected);
  CHECK(read_again(folder, example()).warnings == example().warnings);
}

TEST_CASE("without a reference there are no errors") {
  const TemporaryFolder folder;
  auto summary = example();
  summary.errors.clear();
  CHECK_FALSE(written(folder, summary).contains("errors"));
  CHECK(read_again(folder, summary).errors.empty());
}

TEST_CASE("what water did that flows comes back") {
  const TemporaryFolder folder;
  auto summary = example();
  CHECK_FALSE(written(folder, summary).contains("seepage"));
  summary.seepage = {{0, 1.5e-6, -1.5e-6}, 1e-11, 7, 420};
  const auto again = read_again(folder, summary).seepage;
  REQUIRE(again);
  CHECK(again->through_faces == summary.seepage->through_faces);
  CHECK(again->imbalance == 1e-11);
  CHECK(again->newton_steps == 7);
  CHECK(again->krylov_iterations == 420);
}

TEST_CASE("a summary comes back as it was") {
  const TemporaryFolder folder;
  const auto summary = example();
  const auto again = read_again(folder, summary);
  CHECK(again.probes.at("A").x == 7.5);
  CHECK(again.probes.at("A").y == 5.0);
  CHECK(again.probes.at("A").values == summary.probes.at("A").values);
  CHECK(again.skipped == summary.skipped);
  CHECK(again.status == summary.status);
  CHECK(again.time_step == summary.time_step);
  const auto text = content(folder / "summary.json");
  write_summary(folder / "summary.json", again);
  CHECK(content(folder / "summary.json") == text);
}

TEST_CASE("the comparison with finite elements comes back as it was") {
  const TemporaryFolder folder;
  auto summary = example();
  FemCheck& check = summary.finite_elements.emplace();
  check.unknowns = 26176, check.seconds = 0.25, check.limit = 0.0625, check.local_limit = 0.125;
  FemSoilCheck& sand = check.soils["sand"] = {1234, 56, 0.0125, {}};
  sand.fields["EffectiveStress_XY"] = {std::nan(""), 0.25, 1500, 3.5, -0.5, 0.75, 1.5, 2.5};
  check.warnings = {"sigma'_xy of soil 'sand' is 25 % off"};
  const auto found = written(folder, summary)["finite_elements"];
  CHECK(found["soils"]["sand"]["fields"]["EffectiveStress_XY"]["relative_l2"].is_null());
  CHECK(found["soils"]["sand"]["fields"]["EffectiveStress_XY"]["where"] == json::parse("[3.5, -0.5]"));
  CHECK(found["soils"]["sand"]["fields"]["EffectiveStress_XY"]["local_where"] == json::parse("[1.5, 2.5]"));
  CHECK(found["limit"] == 0.0625);
  CHECK(found["local_limit"] == 0.125);
  const auto text = content(folder / "summary.json");
  write_summary(folder / "summary.json", read_summary(folder / "summary.json"));
  CHECK(content(folder / "summary.json") == text);

  check = {};
  check.skipped = "the water moves";
  CHECK(written(folder, summary)["finite_elements"]["skipped"] == "the water moves");
  CHECK(read_again(folder, summary).finite_elements->skipped == "the water moves");
}

TEST_CASE("factors of safety of stages come back as they were") {
  const TemporaryFolder folder;
  Summary summary = example();
  const Summary::Stage stage{
      .name = "dig", .ended = "rest", .start = 0, .time = 1, .steps = 2, .particles = 3};
  summary.stages = {3, stage};
  summary.stages[1].safety = {
      .stable_at = 1.25, .fails_at = 1.5, .limit_equilibrium = 1.375, .note = "far apart"};
  summary.stages[2].safety = {.stable_at = 50, .fails_at = infinity, .limit_equilibrium = 0, .note = ""};
  const auto stages = written(folder, summary)["stages"];
  CHECK_FALSE(stages[0].contains("safety"));
  CHECK_FALSE(stages[2]["safety"].contains("limit_equilibrium"));
  const Summary again = read_again(folder, summary);
  CHECK_FALSE(again.stages[0].safety);
  REQUIRE(again.stages[1].safety);
  CHECK(again.stages[1].safety->stable_at == 1.25);
  CHECK(again.stages[1].safety->fails_at == 1.5);
  CHECK(again.stages[1].safety->limit_equilibrium == 1.375);
  CHECK(again.stages[1].safety->note == "far apart");
  CHECK(again.stages[2].safety->fails_at == infinity);
  CHECK(again.stages[2].safety->limit_equilibrium == 0);
}

TEST_CASE("every status has its name") {
  const TemporaryFolder folder;
  const std::vector<std::pair<RunStatus, std::string>> names{{RunStatus::completed, "completed"},
                                                             {RunStatus::equilibrium, "equilibrium"},
                                                             {RunStatus::unstable, "unstable"},
                                                             {RunStatus::interrupted, "interrupted"}};
  for (const auto& [status, name] : names) {
    auto summary = example();
    summary.status = status;
    CHECK(written(folder, summary)["status"] == name);
    CHECK(read_summary(folder / "summary.json").status == status);
  }
}

TEST_CASE("numbers that are not finite are null with the reason beside them") {
  const TemporaryFolder folder;
  auto summary = example();
  summary.unbalanced_force_ratio = std::nan("");
  summary.probes["A"].values["PorePressure"] = infinity;
  summary.errors["EffectiveStress_YY"].max_abs = -infinity;
  const auto file = written(folder, summary);
  CHECK(file["unbalanced_force_ratio"].is_null());
  CHECK(file["unbalanced_force_ratio_reason"] == "not a number");
  CHECK(file["probes"]["A"]["values"]["PorePressure"].is_null());
  CHECK(file["probes"]["A"]["values"]["PorePressure_reason"] == "plus infinity");
  const auto again = read_summary(folder / "summary.json");
  CHECK(std::isnan(again.unbalanced_force_ratio));
  CHECK(again.probes.at("A").values == summary.probes.at("A").values);
  CHECK(again.errors.at("EffectiveStress_YY").max_abs == -infinity);
}

TEST_CASE("text that is not UTF-8 does not lose the summary") {
  const TemporaryFolder folder;
  auto summary = example();
  summary.message = "cannot open \xff.toml";
  CHECK(read_again(folder, summary).message == "cannot open \xef\xbf\xbd.toml");
}

TEST_CASE("keys from later versions are passed over") {
  const TemporaryFolder folder;
  auto file = written(folder, example());
  file["colour"] = "red";
  put(folder / "summary.json", file.dump());
  CHECK(read_summary(folder / "summary.json").particles == 3750);
}

TEST_CASE("each missing key is named") {
  const TemporaryFolder folder;
  const auto whole = written(folder, example());
  for (const auto& entry : whole.items()) {
    const std::string& key = entry.key();  // without the first two: of older runs; without the last: all is 1
    if (key == "errors" || key == "warnings" || key == "scaled_inertia") continue;
    auto file = whole;
    file.erase(key);
    put(folder / "summary.json", file.dump());
    CHECK_THROWS_WITH(read_summary(folder / "summary.json"),
                      Contains("summary.json") && Contains("key '" + key + "' is missing"));
  }
}

TEST_CASE("values that make no sense are refused with their key and what is allowed") {
  const TemporaryFolder folder;
  const auto whole = written(folder, example());
  const auto reading = [&](const std::string& pointer, const json& value) {
    auto file = whole;
    file[json::json_pointer(pointer)] = value;
    put(folder / "summary.json", file.dump());
    return read_summary(folder / "summary.json");
  };
  CHECK_THROWS_WITH(reading("/status", "fine"),
                    Contains("key 'status'") && Contains("completed, equilibrium") && Contains("\"fine\""));
  CHECK_THROWS_WITH(reading("/title", 1), Contains("key 'title': must be a string, not 1"));
  CHECK_THROWS_WITH(reading("/steps", -1),
                    Contains("key 'steps': must be a whole number, not negative, not -1"));
  CHECK_THROWS_WITH(reading("/steps", 1.5), Contains("key 'steps'"));
  CHECK_THROWS_WITH(reading("/steps", 1e300), Contains("key 'steps'"));
  CHECK_THROWS_WITH(reading("/threads", 1LL << 40), Contains("key 'threads'"));
  CHECK_THROWS_WITH(reading("/time", "soon"), Contains("key 'time': must be a number or null"));
  CHECK_THROWS_WITH(reading("/time", nullptr), Contains("key 'time_reason' is missing"));
  CHECK_THROWS_WITH(reading("/kernel_correction", 1), Contains("must be true or false"));
  CHECK_THROWS_WITH(reading("/probes", json::array()),
                    Contains("key 'probes': must be an object, not array"));
  CHECK_THROWS_WITH(reading("/probes/A/position", {1, 2, 3}),
                    Contains("key 'probes.A.position': must be two numbers"));
  CHECK_THROWS_WITH(reading("/probes/A/values/PorePressure", "x"),
                    Contains("key 'probes.A.values.PorePressure'"));
  CHECK_THROWS_WITH(reading("/errors/EffectiveStress_YY", 1), Contains("key 'errors.EffectiveStress_YY'"));
}

TEST_CASE("a file that is cut short or something else is a ReadError") {
  const TemporaryFolder folder;
  write_summary(folder / "summary.json", example());
  const auto text = content(folder / "summary.json");
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    put(folder / "summary.json", text.substr(0, length));
    CHECK_THROWS_AS(read_summary(folder / "summary.json"), ReadError);
  }
  for (const auto* other : {"[]", "3", "null", "{}", "time,a\n0,1\n", "\xff\xfe"}) {
    put(folder / "summary.json", other);
    CHECK_THROWS_AS(read_summary(folder / "summary.json"), ReadError);
  }
  put(folder / "summary.json", std::string(100000, '['));
  CHECK_THROWS_AS(read_summary(folder / "summary.json"), ReadError);
  CHECK_THROWS_AS(read_summary(folder / "none.json"), ReadError);
}

TEST_CASE("on a full disk the old summary stays") {
  const TemporaryFolder folder;
  write_summary(folder / "summary.json", example());
  const auto before = content(folder / "summary.json");
  {
    const FileSizeLimit limit(100);
    CHECK_THROWS_AS(write_summary(folder / "summary.json", example()), WriteError);
  }
  CHECK(content(folder / "summary.json") == before);
  CHECK(names_in(folder.path()).size() == 1);
}

TEST_CASE("the energy budget of a summary is read as it was written, and is left out where there is none") {
  const TemporaryFolder folder;
  Summary summary = example();
  CHECK_FALSE(written(folder, summary).contains("energy_budget"));
  CHECK_FALSE(read_again(folder, summary).energy);
  summary.energy = {7.4, 0.07, 0.01, 6.4, 0.76, 0.03, 0.04, 0.01, 0.05, 0.02, 0.3, 0.08};
  CHECK(written(folder, summary).at("energy_budget") == json({{"released", 7.4},
                                                              {"kinetic", 0.07},
                                                              {"elastic", 0.01},
                                                              {"plastic", 6.4},
                                                              {"control", 0.76},
                                                              {"contact", 0.03},
                                                              {"wall_friction", 0.04},
                                                              {"walls", 0.01},
                                                              {"stress_diffusion", 0.05},
                                                              {"bulk_viscosity", 0.02},
                                                              {"pore_water", 0.3},
                                                              {"unaccounted", 0.08}}));
  const auto read = read_again(folder, summary).energy;
  REQUIRE(read);
  CHECK(read->released == 7.4);
  CHECK(read->control == 0.76);
  CHECK(read->contact == 0.03);
  CHECK(read->friction == 0.04);
  CHECK(read->walls == 0.01);
  CHECK(read->water == 0.3);
  CHECK(read->unaccounted == 0.08);
}
