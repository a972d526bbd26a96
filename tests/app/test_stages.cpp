// Cases with stages, from the command line: plan, series, summary, resume, and starting from another run.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const std::string pit_case = R"(title = "Pit"
[particles]
spacing = 0.5
[[soil]]
name = "ground"
polygon = [[0, 0], [6, 0], [6, 3], [0, 3]]
youngs_modulus = 15e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
[[soil]]
name = "fill"
polygon = [[0, 3], [2, 3], [2, 4], [0, 4]]
youngs_modulus = 15e6
poissons_ratio = 0.3
unit_weight_saturated = 20e3
[[boundary]]
kind = "fixed"
from = [0, 0]
to = [6, 0]
[[boundary]]
kind = "roller"
from = [0, 0]
to = [0, 5]
[[boundary]]
kind = "roller"
from = [6, 0]
to = [6, 5]
[loading]
damping = "adaptive"
[time]
end = 2
[stop]
unbalanced_force_ratio = 1e-4
[output]
interval = 0.02
[[probe]]
name = "A"
position = [1, 1]
[[probe]]
name = "top"
position = [1, 3.5]
[[stage]]
name = "dig"
duration = 2
excavate_within = [[[3, 2], [6, 2], [6, 3], [3, 3]]]
[[stage]]
name = "place"
duration = 2
fill = ["fill"]
reset_displacements = true
)";

nlohmann::json summary_of(const Workplace& place, const std::string& folder) {
  return nlohmann::json::parse(text_of(place.folder() / folder / "summary.json"));
}

}  // namespace

TEST_CASE("a case runs through its stages, and says so") {
  const Workplace place;
  place.write("pit.toml", pit_case);
  const Outcome plan = place.porosph("check pit.toml");
  CHECK_THAT(plan.out, Contains("'dig': excavates within an outline") &&
                           Contains("'place': places fill; displacements count from here") &&
                           Contains("2 s or until at rest, 60 particles"));
  const Outcome outcome = place.porosph("run pit.toml");
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("stage 'dig' from") && Contains("stage 'place' from"));
  const auto summary = summary_of(place, "results/pit");
  const auto& stages = summary.at("stages");
  REQUIRE(stages.size() == 3);
  CHECK(stages[0].at("name") == "start");
  CHECK(stages[0].at("particles") == 72);
  CHECK(stages[1].at("particles") == 60);
  CHECK(stages[2].at("particles") == 68);
  std::int64_t steps = 0;
  for (const auto& stage : stages) {
    CHECK(stage.at("ended") == "rest");
    steps += stage.at("steps").get<std::int64_t>();
  }
  CHECK(summary.at("steps") == steps);
  CHECK(stages[1].at("start") == stages[0].at("time"));
  CHECK(stages[0].at("probes").at("top").at("values").at("Displacement_Y").is_null());
  CHECK(stages[2].at("probes").at("top").at("values").at("Displacement_Y").get<double>() < 0);
  CHECK_THAT(text_of(place.folder() / "results/pit/history.csv"), Contains("nan"));
  CHECK(place.porosph("render results/pit --field Displacement:Y --time all --out p.png").status == 0);
  CHECK(place.porosph("report results/pit --out report").status == 0);
  CHECK_THAT(text_of(place.folder() / "report/index.html"), Contains("Stages") && Contains("place"));
  CHECK_THAT(place.porosph("fem pit.toml").err, Contains("porosph fem is for a case without stages"));
}

TEST_CASE("a run with stages resumes in each of them to the same bits") {
  const Workplace place;
  place.write("pit.toml", pit_case);
  const std::string run = "run pit.toml --threads 1 --quiet";
  REQUIRE(place.porosph(run + " --out whole").status == 0);
  const auto stages = summary_of(place, "whole").at("stages");
  for (std::size_t k = 0; k < stages.size(); ++k) {  // killed in the middle of the stage
    const double middle = 0.5 * (stages[k].at("start").get<double>() + stages[k].at("time").get<double>());
    char frame[64];
    std::snprintf(frame, sizeof frame, "parts/frames/particles_%06d.vtp", static_cast<int>(middle / 0.02));
    place.shell("'" POROSPH_PROGRAM "' " + run +
                " --out parts --resume --checkpoint-every 1e-6 & while [ ! -e " + std::string(frame) +
                " ] && kill -0 $!; do sleep 0.002; done; kill -KILL $!; wait $!");
  }
  REQUIRE(place.porosph(run + " --out parts --resume").status == 0);
  CHECK(text_of(place.folder() / "parts/history.csv") == text_of(place.folder() / "whole/history.csv"));
  CHECK(summary_of(place, "parts").at("stages") == stages);
  for (const auto& file : fs::directory_iterator(place.folder() / "whole/frames"))
    CHECK(text_of(file.path()) == text_of(place.folder() / "parts/frames" / file.path().filename()));
}

TEST_CASE("a case starts from the last state of another") {
  const Workplace place;
  std::string without_stages = pit_case.substr(0, pit_case.find("[[stage]]"));
  const std::string spacing = "spacing = 0.5\n";  // cells end at the ground, whether fill lies on it or not
  without_stages.insert(without_stages.find(spacing) + spacing.size(), "arrangement = \"stretched\"\n");
  const auto fill = without_stages.find("[[soil]]\nname = \"fill\"");
  std::string ground = without_stages;
  ground.erase(fill, ground.find("[[boundary]]") - fill);
  ground.erase(ground.find("[[probe]]\nname = \"top\""));
  place.write("ground.toml", ground);
  REQUIRE(place.porosph("run ground.toml --quiet").status == 0);
  const double before =
      summary_of(place, "results/ground").at("probes").at("A").at("values").at("Displacement_Y");

  REQUIRE(place.porosph("run ground.toml --quiet --out same --set start_from=results/ground").status == 0);
  const double same = summary_of(place, "same").at("probes").at("A").at("values").at("Displacement_Y");
  CHECK(same == Approx(before).epsilon(0.005));
  CHECK(summary_of(place, "same").at("steps") < summary_of(place, "results/ground").at("steps"));

  place.write("filled.toml", without_stages);
  REQUIRE(place.porosph("run filled.toml --quiet --out filled --set start_from=results/ground").status == 0);
  const double filled = summary_of(place, "filled").at("probes").at("A").at("values").at("Displacement_Y");
  CHECK(filled < 1.1 * before);
  CHECK_THAT(place
                 .porosph("run ground.toml --out other --set start_from=results/ground "
                          "--set particles.spacing=0.4")
                 .err,
             Contains("soil 'ground' does not fit the state to start from"));
}
