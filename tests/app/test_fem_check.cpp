// What a run says of itself: its difference from finite elements, and soil that may have slid.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

const char* const submerged_ground = R"(title = "Submerged ground"
[particles]
spacing = 0.25
[[soil]]
name = "sand"
polygon = [[0, 0], [3, 0], [3, 5], [0, 5]]
youngs_modulus = 15e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
[water]
level = 8
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [3, 0]
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 5]
[[boundary]]
kind = "roller"
from = [3, 0]
to = [3, 5]
[loading]
damping = "adaptive"
[time]
end = 20
courant = 0.7
[stop]
unbalanced_force_ratio = 1e-5
[check]
finite_elements = true
)";

nlohmann::json check_of(const Workplace& place) {
  return nlohmann::json::parse(text_of(place.folder() / "run/summary.json"))["finite_elements"];
}

}  // namespace

TEST_CASE("a run at rest says how far it is from finite elements") {
  const Workplace place;
  place.write("ground.toml", submerged_ground);
  const Outcome outcome = place.porosph("run ground.toml --out run");
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("soil 'sand' against finite elements: sigma'_"));
  CHECK(outcome.err.empty());
  const auto sand = check_of(place)["soils"]["sand"];
  CHECK(sand["particles"] == 252);
  CHECK(sand["fields"]["EffectiveStress_YY"]["relative_l2"].get<double>() < 0.01);
  CHECK(sand["fields"]["EffectiveStress_YY"]["relative_l2"].get<double>() > 1e-5);
  CHECK(place
            .porosph("report run --out page --fail-if "
                     "'finite_elements.soils.sand.fields.EffectiveStress_YY.relative_l2>0.01'")
            .status == 0);
  CHECK_THAT(text_of(place.folder() / "page/index.html"), Contains("Checked by finite elements"));
}

TEST_CASE("the conventional form is warned of, with its reason, also when quiet and in the report") {
  const Workplace place;
  place.write("ground.toml", submerged_ground);
  const Outcome outcome =
      place.porosph("run ground.toml --out run --quiet --set formulation.motion=conventional");
  CHECK(outcome.status == 0);
  const std::string reason = "of soil 'sand' is";
  CHECK_THAT(outcome.err, Contains(reason) && Contains("% off finite elements, most at (") &&
                              Contains("the conventional form, eq. (17), is known to be wrong under water"));
  REQUIRE(place.porosph("report run --out page").status == 0);
  CHECK_THAT(text_of(place.folder() / "page/index.html"), Contains("is known to be wrong under water"));
}

TEST_CASE("probes stand beside what finite elements have there, also far from the origin") {
  const Workplace place;
  std::string text = std::string(submerged_ground) + "[[probe]]\nname = \"A\"\nposition = [1.5, 2]\n";
  for (const auto& [here, far] :
       {std::pair<std::string, std::string>{"[[0, 0], [3, 0], [3, 5], [0, 5]]",
                                            "[[4e5, 2e5], [400003, 2e5], [400003, 200005], "
                                            "[4e5, 200005]]"},
        {"= [0, 0]", "= [4e5, 2e5]"},
        {"= [3, 0]", "= [400003, 2e5]"},
        {"= [0, 5]", "= [4e5, 200005]"},
        {"= [3, 5]", "= [400003, 200005]"},
        {"= [1.5, 2]", "= [400001.5, 200002]"},
        {"level = 8", "level = 200008"}})
    for (auto at = text.find(here); at != std::string::npos; at = text.find(here, at + far.size()))
      text.replace(at, here.size(), far);
  place.write("far.toml", text);
  place.write("ground.toml",
              std::string(submerged_ground) + "[[probe]]\nname = \"A\"\nposition = [1.5, 2]\n");
  REQUIRE(place.porosph("run ground.toml --out run").status == 0);
  const auto near_by = check_of(place);
  const Outcome outcome = place.porosph("run far.toml --out run --force");
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK_THAT(outcome.out, Contains("A (400001.5, 200002): sigma'_yy = "));
  CHECK_THAT(outcome.out, Contains(" mm; finite elements -30.570 kPa, "));
  CHECK_THAT(outcome.out, Contains(" mm at (40000"));  // the zigzag
  const auto check = check_of(place);
  CHECK(check["soils"]["sand"]["particles"] == 252);
  CHECK(check["probes"]["A"]["EffectiveStress_YY"].get<double>() == Approx(-3 * 10190.0));
  CHECK(check["soils"]["sand"]["fields"]["EffectiveStress_YY"]["relative_l2"].get<double>() ==
        Approx(near_by["soils"]["sand"]["fields"]["EffectiveStress_YY"]["relative_l2"].get<double>())
            .epsilon(1e-4));
}

TEST_CASE("what is not compared says why") {
  const Workplace place;
  place.write("ground.toml", submerged_ground);
  CHECK(place.porosph("run ground.toml --out run --set check.finite_elements=false").status == 0);
  CHECK(check_of(place)["skipped"] == "check.finite_elements = false");
  const Outcome moving = place.porosph("run ground.toml --out run --force --set time.end=0.05");
  CHECK(moving.status == 0);
  CHECK_THAT(check_of(place)["skipped"].get<std::string>(), Contains("ended in motion"));
  CHECK_THAT(moving.out, Contains("not compared with finite elements: the run ended in motion"));
  CHECK(place
            .porosph("run ground.toml --out run --force --set soil.sand.no_tension=true --set "
                     "check.finite_elements=auto")
            .status == 0);
  CHECK_THAT(check_of(place)["skipped"].get<std::string>(), Contains("'sand' carries no tension"));

  const Outcome refused = place.porosph("run ground.toml --out other --set soil.sand.no_tension=true");
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("key 'check.finite_elements' = true: they do not apply"));
  CHECK_FALSE(std::filesystem::exists(place.folder() / "other"));
}

// Finite elements have small strain: with ten times the stiffness of the shipped case the particles have it
// too.
TEST_CASE("displacements of a layered embankment are those of finite elements") {
  const std::string arrangement =
      GENERATE("fitted", "stretched --set particles.smoothing_ratio=1",
               "surface --set particles.smoothing_ratio=1", "disordered --set particles.disorder=0.1");
  CAPTURE(arrangement);
  const Workplace place;
  const Outcome outcome = place.porosph(
      "run " POROSPH_SOURCE_DIR
      "/cases/embankment_layered.toml --set soil.gravel.youngs_modulus=600e6 --set "
      "soil.clay.youngs_modulus=80e6 --set soil.fill.youngs_modulus=80e6 --set loading.damping=adaptive "
      "--set stop.unbalanced_force_ratio=1e-5 --set time.end=100 --set check.finite_elements=true --out run "
      "--set particles.arrangement=" +
      arrangement);
  REQUIRE(outcome.status == 0);
  const nlohmann::json check = check_of(place);
  CHECK(check["soils"].size() == 3);
  for (const auto& soil : check["soils"]) {
    CHECK(soil["fields"]["Displacement_X"]["relative_l2"] < 0.008);
    CHECK(soil["fields"]["Displacement_Y"]["relative_l2"] < 0.003);
  }
}

TEST_CASE("stiff soils beside soft ones move as finite elements say") {
  struct Scene {
    const char *arrangement, *gravel, *fill;
    double u_x, u_y;  ///< allowed for the gravel; unheld it has 0.28 and 0.08, 0.71 and 3.5
  };
  const auto scene = GENERATE(Scene{"disordered --set particles.disorder=0.1", "8e9", "4e9", 0.07, 0.05},
                              Scene{"fitted", "800e9", "400e9", 0.2, 0.4});
  CAPTURE(scene.arrangement);
  const Workplace place;
  const std::string settings = std::string(" --set particles.spacing=0.4 --set particles.arrangement=") +
                               scene.arrangement + " --set soil.clay.youngs_modulus=80e6" +
                               " --set soil.gravel.youngs_modulus=" + scene.gravel +
                               " --set soil.fill.youngs_modulus=" + scene.fill +
                               " --set loading.damping=adaptive --set time.end=1000" +
                               " --set stop.unbalanced_force_ratio=1e-6 --set check.finite_elements=true";
  REQUIRE(place
              .porosph("run " POROSPH_SOURCE_DIR "/cases/embankment_layered.toml --out run --no-frames" +
                       settings)
              .status == 0);
  const auto fields = check_of(place)["soils"]["gravel"]["fields"];
  CHECK(fields["Displacement_X"]["relative"].get<double>() < scene.u_x);
  CHECK(fields["Displacement_Y"]["relative"].get<double>() < scene.u_y);
}

TEST_CASE("a slope that slides and comes to rest again is warned of") {
  const Workplace place;
  const auto rain = [&](const std::string& end) {
    const Outcome outcome =
        place.porosph("run " POROSPH_SOURCE_DIR
                      "/cases/failure/rain_slide.toml --no-frames --force --set particles.spacing=1 --set "
                      "time.end='" +
                      end + "' --out run");
    REQUIRE(outcome.status == 0);
    const auto warnings =
        nlohmann::json::parse(text_of(place.folder() / "run/summary.json"))["warnings"].dump();
    CHECK((outcome.err.find("it may have slid") != std::string::npos) ==
          (warnings.find("it may have slid") != std::string::npos));
    return warnings;
  };
  CHECK_THAT(rain("4 d"), Contains("soil has moved by up to ") && Contains("it may have slid"));
  CHECK_THAT(rain("1 d"), !Contains("it may have slid"));
}
