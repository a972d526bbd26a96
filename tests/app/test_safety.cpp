// porosph safety as a user runs it.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

const std::string slope = R"(title = "Slope"
[particles]
spacing = 1
[[soil]]
name = "loam"
polygon = [[0, 0], [32, 0], [12, 10], [0, 10]]
youngs_modulus = 100e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
law = "mohr_coulomb"
cohesion = 10e3
friction_angle = 20
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [32, 0]
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 10]
[time]
end = 1
)";

/// The slope is dug out of level ground.
std::string dug(const std::string& keys_of_stage) {
  std::string text = slope;
  const std::string outline = "[[0, 0], [32, 0], [12, 10], [0, 10]]";
  text.replace(text.find(outline), outline.size(), "[[0, 0], [32, 0], [32, 10], [0, 10]]");
  return text +
         "courant = 0.6\n[stop]\nunbalanced_force_ratio = 1e-4\n[loading]\ndamping = \"adaptive\"\n"
         "k0_stress = true\n[[stage]]\nname = \"dig\"\nduration = 9\n"
         "excavate_within = [[[12, 10], [32, 0], [33, 0], [33, 10]]]\n" +
         keys_of_stage + "[[stage]]\nname = \"wait\"\nduration = 1\n";
}

nlohmann::json stages_of(const Workplace& place, const std::string& folder) {
  return nlohmann::json::parse(text_of(place.folder() / folder / "summary.json"))["stages"];
}

nlohmann::json answer(const Workplace& place, const std::string& folder) {
  return nlohmann::json::parse(text_of(place.folder() / folder / "safety.json"));
}

bool exists(const Workplace& place, const std::string& file) {
  return std::filesystem::exists(place.folder() / file);
}

}  // namespace

TEST_CASE("the factor of safety over a setting is a curve", "[safety]") {
  const Workplace place;
  place.write("slope.toml", slope);
  REQUIRE(place.porosph("safety slope.toml --bracket 0.05 --out curve --vary soil.loam.cohesion=5e3,10e3")
              .status == 0);
  CHECK(exists(place, "curve/curve.png"));
  const std::string table = text_of(place.folder() / "curve/curve.csv");
  std::istringstream lines(table);
  std::string head, weak, strong;
  std::getline(lines, head), std::getline(lines, weak), std::getline(lines, strong);
  CHECK(head == "soil.loam.cohesion,stable_at,fails_at,bishop,spencer,spencer_any_shape");
  const auto number = [](const std::string& line, int column) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i <= column; ++i) std::getline(cells, cell, ',');
    return std::stod(cell);
  };
  for (const int column : {0, 1, 2, 3, 4}) CHECK(number(strong, column) > 1.1 * number(weak, column));
}

TEST_CASE("a report takes what safety found as a part") {
  const Workplace place;
  place.write("slope.toml", slope);
  REQUIRE(place.porosph("run slope.toml --set time.end=0.05 --quiet --out run").status == 0);
  REQUIRE(place.porosph("safety slope.toml --bracket 0.5 --quiet --out found").status == 0);
  const Outcome report = place.porosph("report run found --instants 0 --out page");
  INFO(report.err);
  REQUIRE(report.status == 0);
  const std::string page = text_of(place.folder() / "page/index.html");
  CHECK_THAT(page, Contains("<h2>Factor of safety: Slope</h2>") && Contains("study_1_mechanism.png") &&
                       Contains("study_1_safety.png") && Contains("Limit equilibrium: Bishop on circles"));
  CHECK(exists(place, "page/study_1_mechanism.png"));
  CHECK_THAT(text_of(place.folder() / "found/index.html"), Contains("<h2>Trials</h2>"));
}

TEST_CASE("a factor of safety comes with both numbers, its curve and its mechanism") {
  const Workplace place;
  place.write("slope.toml", slope);
  const Outcome outcome = place.porosph("safety slope.toml --bracket 0.05 --out found");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("strength reduction, particles") && Contains("Bishop on circles"));
  const auto json = answer(place, "found");
  const double rests = json["strength_reduction"]["stable_at"],
               fails = json["strength_reduction"]["fails_at"];
  CHECK(fails - rests < 0.0501);
  CHECK(rests > 1.3);
  CHECK(fails < 1.5);
  CHECK(json["limit_equilibrium"]["bishop"].get<double>() == Approx(1.378).margin(0.01));
  CHECK(json["limit_equilibrium"]["spencer"].get<double>() == Approx(1.376).margin(0.01));
  for (const char* file :
       {"safety.csv", "safety.png", "mechanism.png", "slip_surfaces.csv", "slip_surfaces.vtp", "case.toml"})
    CHECK(exists(place, std::string("found/") + file));
  CHECK_THAT(text_of(place.folder() / "found/safety.csv"), Contains("at rest") && Contains("moved far"));
}

TEST_CASE("a weak seam in which the particles hardly slide is warned of") {
  const Workplace place;
  std::string seam = slope;
  const auto soils = seam.find("[[soil]]"), boundaries = seam.find("[[boundary]]");
  const auto soil = [](const std::string& name, const std::string& polygon, const std::string& strength) {
    return "[[soil]]\nname = \"" + name + "\"\npolygon = " + polygon +
           "\nyoungs_modulus = 100e6\npoissons_ratio = 0.3\nunit_weight_saturated = 20e3\n"
           "law = \"mohr_coulomb\"\n" +
           strength;
  };
  const std::string loam = "cohesion = 30e3\nfriction_angle = 20\n";
  seam.replace(
      soils, boundaries - soils,
      soil("below", "[[0, 0], [32, 0], [28, 2], [0, 2]]", loam) +
          soil("seam", "[[0, 2], [28, 2], [26, 3], [0, 3]]", "cohesion = 1e3\nfriction_angle = 5\n") +
          soil("above", "[[0, 3], [26, 3], [12, 10], [0, 10]]", loam));
  place.write("seam.toml", seam);
  const Outcome outcome = place.porosph("safety seam.toml --bracket 0.1 --quiet --out found");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.err, Contains("above the") && Contains("Spencer on any shape"));
  CHECK_THAT(outcome.err, Contains("'seam'") && Contains("one row"));
  const auto warnings = answer(place, "found")["warnings"];
  CHECK(warnings.size() >= 2);
}

TEST_CASE("limit equilibrium stands alone, without a particle computed") {
  const Workplace place;
  place.write("slope.toml", slope);
  const Outcome outcome =
      place.porosph("safety slope.toml --method limit-equilibrium --set water.level=15 --out found");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto json = answer(place, "found");
  CHECK_FALSE(json.contains("strength_reduction"));
  CHECK(json["limit_equilibrium"]["bishop"].get<double>() == Approx(1.82).margin(0.02));  // under water
  CHECK_FALSE(exists(place, "found/safety.csv"));
  CHECK(exists(place, "found/mechanism.png"));
  const Outcome undrained = place.porosph(
      "safety slope.toml --method limit-equilibrium --quiet --set soil.loam.law=tresca --set "
      "soil.loam.undrained_strength=30e3 --out clay");
  CHECK(undrained.status == 2);  // cohesion is not a key of this law
}

TEST_CASE("strength reduction alone leaves limit equilibrium out") {
  const Workplace place;
  place.write("slope.toml", slope);
  REQUIRE(place.porosph("safety slope.toml --method strength-reduction --bracket 0.2 --quiet --out found")
              .status == 0);
  CHECK_FALSE(answer(place, "found").contains("limit_equilibrium"));
  CHECK_FALSE(exists(place, "found/slip_surfaces.csv"));
}

TEST_CASE("a stage of a run has its factor of safety") {
  const Workplace place;
  place.write("dug.toml", dug("safety = true\nsafety_bracket = 0.02\n"));
  CHECK_THAT(place.porosph("check dug.toml").out, Contains("the factor of safety is found at its end"));
  const Outcome outcome = place.porosph("run dug.toml --out run");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("factor of safety of stage 'dig'") && Contains("  factor of safety 1.3"));
  const auto stages = stages_of(place, "run");
  REQUIRE(stages.size() == 3);
  CHECK_FALSE(stages[0].contains("safety"));
  CHECK_FALSE(stages[2].contains("safety"));
  const auto safety = stages[1]["safety"];
  const double rests = safety["stable_at"], fails = safety["fails_at"];
  CHECK(fails - rests < 0.0201);
  CHECK(rests > 1.3);
  CHECK(fails < 1.45);
  CHECK(safety["limit_equilibrium"].get<double>() == Approx(1.376).margin(0.01));
  for (const char* file : {"safety.json", "safety.csv", "safety.png", "mechanism.png", "index.html"})
    CHECK(exists(place, std::string("run/safety_dig/") + file));
  REQUIRE(place.porosph("report run --instants 0 --out page").status == 0);
  const std::string page = text_of(place.folder() / "page/index.html");
  CHECK_THAT(page, Contains("Factor of safety: Slope, stage") && Contains("study_1_mechanism.png") &&
                       Contains("on slip surfaces"));
  // The same from its last state, which is that of the stage after.
  const Outcome alone = place.porosph("safety dug.toml --bracket 0.05 --jobs 2 --out alone");
  INFO(alone.err);
  REQUIRE(alone.status == 0);
  CHECK_THAT(alone.out, Contains("stage 'wait' ended at"));
  const auto found = answer(place, "alone")["strength_reduction"];
  CHECK(found["stable_at"].get<double>() == Approx(rests).margin(0.05));
  CHECK(found["fails_at"].get<double>() == Approx(fails).margin(0.05));
  // From another run's last state.
  place.write("slope.toml",
              slope + "[loading]\ndamping = \"adaptive\"\n[stop]\nunbalanced_force_ratio = 1e-4\n");
  REQUIRE(place.porosph("run slope.toml --quiet --out ground").status == 0);
  const Outcome from =
      place.porosph("safety slope.toml --set start_from=ground --bracket 0.2 --quiet --out from");
  INFO(from.err);
  CHECK(from.status == 0);
  // Started again, the run leaves nothing of the last one.
  REQUIRE(place.porosph("run dug.toml --out run --force --quiet --set stage.dig.safety_bracket=0.2").status ==
          0);
  const auto wide = stages_of(place, "run")[1]["safety"];
  CHECK(wide["fails_at"].get<double>() - wide["stable_at"].get<double>() > 1.5 * (fails - rests));
}

TEST_CASE("a run resumes before and after a factor of safety to the same numbers") {
  const Workplace place;
  place.write("dug.toml", dug("safety = true\nsafety_bracket = 0.01\n"));
  const std::string run = "run dug.toml --threads 1 --checkpoint-every 1e-6";
  REQUIRE(place.porosph(run + " --quiet --out whole").status == 0);
  // Interrupted while trials run, and again until it is done.
  const std::string begin = "'" POROSPH_PROGRAM "' " + run + " --out parts --resume >log & ",
                    wait = " log && kill -0 $!; do sleep 0.002; done; ";
  CHECK(place.shell(begin + "while ! grep -q strength" + wait + "kill -INT $!; wait $!") == 130);
  CHECK_FALSE(exists(place, "parts/safety_dig/safety.json"));
  CHECK(stages_of(place, "parts").size() == 1);
  CHECK(place.shell(begin + "while ! grep -q \"stage 'wait'\"" + wait + "kill -KILL $!; wait $!") != 2);
  REQUIRE(place.porosph(run + " --quiet --out parts --resume").status == 0);
  CHECK(stages_of(place, "parts") == stages_of(place, "whole"));
  CHECK(text_of(place.folder() / "parts/safety_dig/safety.csv") ==
        text_of(place.folder() / "whole/safety_dig/safety.csv"));
  CHECK(text_of(place.folder() / "parts/history.csv") == text_of(place.folder() / "whole/history.csv"));
}

TEST_CASE("a stage that cannot have a factor of safety says why") {
  const Workplace place;
  // At rest in its own stage by strength that the next one takes away.
  place.write("dug.toml", dug("set = [\"soil.loam.cohesion = 1e3\", \"soil.loam.friction_angle = 5\"]\n"));
  const Outcome fails = place.porosph("safety dug.toml --quiet --set stop.displacement=0.5 --out found");
  CHECK(fails.status != 0);
  CHECK_THAT(fails.err, Contains("stage 'dig' fails with the soil's full strength"));
}

TEST_CASE("a slope whose factor is known is let fail") {
  const Workplace place;
  place.write("slope.toml", slope + "[[probe]]\nname = \"crest\"\nposition = [11, 9.5]\n");
  const std::string safety = "safety slope.toml --method strength-reduction --bracket 0.2 --quiet --force ";
  const Outcome outcome = place.porosph(safety + "--then-run=2 --out found");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  for (const char* file : {"rest/summary.json", "runout/summary.json", "runout/case.toml", "runout.png"})
    CHECK(exists(place, std::string("found/") + file));
  const auto summary = [&](const std::string& run) {
    return nlohmann::json::parse(text_of(place.folder() / "found" / run / "summary.json"));
  };
  CHECK(summary("rest")["status"] == "equilibrium");
  const auto sunk = [&](const std::string& run) {
    return -summary(run)["probes"]["crest"]["values"]["Displacement_Y"].get<double>();
  };
  CHECK(sunk("rest") < 0.05);
  CHECK(sunk("runout") > 1);
  const Outcome strong = place.porosph(safety + "--then-run=1.01 --out found");
  CHECK(strong.status == 2);
  CHECK_THAT(strong.err, Contains("--then-run=1.01: must be from"));
  const Outcome without =
      place.porosph("safety slope.toml --method limit-equilibrium --quiet --then-run --out alone");
  CHECK(without.status == 2);
  CHECK_THAT(without.err, Contains("--then-run needs strength reduction"));
}

TEST_CASE("the factor of safety falls as water rises over time, to that of steady seepage") {
  const auto wet = [](const std::string& mode, const std::string& end, const std::string& level) {
    std::string text = slope;
    text.replace(
        text.find("friction_angle = 20\n"), 20,
        "friction_angle = 30\npermeability = 1e-5\nretention = { model = \"van_genuchten\", alpha = 2, "
        "n = 2 }\n");
    text.replace(text.find("end = 1\n"), 8, "end = " + end + "\n");
    const auto face = [](const std::string& kind, const std::string& along) {
      return "[[water.face]]\nkind = \"" + kind + "\"\n" + along;
    };
    return text + "[water]\nmode = \"" + mode + "\"\n" +
           face("head", level + "\nfrom = [0, 0]\nto = [0, 10]\n") +
           face("seepage", "from = [12, 10]\nto = [32, 0]\n") +
           face("closed", "from = [0, 0]\nto = [32, 0]\n") +
           face("closed", "from = [0, 10]\nto = [12, 10]\n");
  };
  const Workplace place;
  place.write("rising.toml", wet("transient", "1e7", "level_over_time = [[0, 1], [1e5, 9]]"));
  place.write("steady.toml", wet("steady", "1", "level = 9"));
  const auto fails_at = [&](const std::string& what, const std::string& folder) {
    const Outcome outcome = place.porosph("safety " + what + " --method strength-reduction --out " + folder);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(exists(place, folder + "/mechanism.png"));
    return answer(place, folder)["strength_reduction"]["fails_at"].get<double>();
  };
  const double before = fails_at("rising.toml --at 0", "before"), after = fails_at("rising.toml", "after");
  CHECK(before - after > 0.2);
  CHECK(after == Approx(fails_at("steady.toml", "steady")).margin(0.02));
}
