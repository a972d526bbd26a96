// What `check` and `run` say about a case before it is computed.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// Level ground of 10 m x 6 m.
std::string ground(const std::string& particles, const std::string& soil, const std::string& water) {
  return "title = 'Ground'\n[particles]\n" + particles +
         "\n[[soil]]\nname = 'sand'\npolygon = [[0, 0], [10, 0], [10, 6], [0, 6]]\npoissons_ratio = 0.3\n" +
         soil + "\n[water]\n" + water +
         "\n[[boundary]]\nkind = 'fixed'\nfrom = [0, 0]\nto = [10, 0]\n[[boundary]]\nkind = 'roller'\nfrom = "
         "[0, 0]\n"
         "to = [0, 6]\n[[boundary]]\nkind = 'roller'\nfrom = [10, 0]\nto = [10, 6]\n[loading]\ndamping = "
         "'adaptive'\n"
         "[time]\nend = 5\ncourant = 0.9\n[stop]\nunbalanced_force_ratio = 1e-4\n[[probe]]\nname = "
         "'A'\nposition = [5, 3]\n";
}
const std::string sand = "youngs_modulus = 15e6\nunit_weight_saturated = 20e3";

nlohmann::json summary(const Workplace& place, const std::string& folder) {
  return nlohmann::json::parse(text_of(place.folder() / folder / "summary.json"));
}

double number_after(const std::string& text, const std::string& label) {
  std::smatch found;
  REQUIRE(std::regex_search(text, found, std::regex(label + "([0-9.e+-]+)")));
  return std::stod(found[1]);
}

}  // namespace

TEST_CASE("level ground has its weight at spacings that do not divide it") {
  const Workplace place;
  for (const std::string spacing : {"0.7", "0.45", "1.1"}) {
    CAPTURE(spacing);
    place.write("ground.toml", ground("spacing = " + spacing, sand, "level = 0"));
    const Outcome run = place.porosph("run ground.toml --out results --force --no-frames");
    REQUIRE(run.status == 0);
    const double stress = summary(place, "results")["probes"]["A"]["values"]["EffectiveStress_YY"];
    CHECK(stress == Approx(-60e3).epsilon(0.006));
  }
}

TEST_CASE("check says what is wet, what the particles carry and how far the soil settles") {
  const Workplace place;
  place.write("ground.toml", ground("spacing = 0.7", sand, "level = 4.5"));
  const Outcome check = place.porosph("check ground.toml");
  CHECK(check.status == 0);
  CHECK(check.err.empty());
  CHECK_THAT(check.out, Contains("45 of 60 m2 of soil are below its level (75 %)") &&
                            Contains("of 'sand' carry 60 of its 60 m2") &&
                            Contains("smoothing length 0.7 m, surface") &&
                            Contains("lets soil 'sand' settle by about 0."));
}

TEST_CASE("warnings stand on the terminal and in summary.json") {
  const Workplace place;
  place.write("ground.toml",
              ground("spacing = 0.5", "youngs_modulus = 15e6\nunit_weight_saturated = 20", "level = 6"));
  const Outcome check = place.porosph("check ground.toml"),
                run = place.porosph("run ground.toml --no-frames --out results");
  CHECK_THAT(check.err,
             Contains("warning: soil[0].unit_weight_saturated = 20 N/m3 looks like a value in kN/m3"));
  CHECK(check.err == run.err);
  const auto warnings = summary(place, "results")["warnings"];
  REQUIRE(warnings.size() == 1);
  CHECK("porosph: warning: " + warnings[0].get<std::string>() + "\n" == run.err);
  place.write("sound.toml", ground("spacing = 0.5", sand, "level = 6"));
  REQUIRE(place.porosph("run sound.toml --no-frames --out sound").err.empty());
  CHECK(summary(place, "sound")["warnings"].empty());
}

TEST_CASE("a run that soft soil breaks names the stiffness, not the time step") {
  const Workplace place;
  place.write("ground.toml", ground("spacing = 0.5\narrangement = 'lattice'",
                                    "youngs_modulus = 15e3\nunit_weight_saturated = 20e3", "level = 6"));
  const Outcome run = place.porosph("run ground.toml --no-frames --out results");
  CHECK(run.status == 3);
  CHECK_THAT(run.out, Contains("soil too soft for its weight: soil[0].youngs_modulus = 15000 Pa") &&
                          Contains("15000 kPa is 15e6 Pa") && !Contains("time.courant"));
}

TEST_CASE("the estimate of memory is right within a factor of 1.5") {
  const Workplace place;
  const std::string settings =
      GENERATE(as<std::string>(), "", "--set particles.arrangement=disordered --set particles.disorder=0.2",
               "--set particles.arrangement=lattice --set formulation.motion=proposed",
               "--set particles.smoothing_ratio=2");
  const std::string spacing = GENERATE(as<std::string>(), "0.03", "0.5");
  CAPTURE(settings, spacing);
  place.write("ground.toml", ground("spacing = " + spacing, sand, "level = 6"));
  const std::string arguments = "ground.toml --set time.courant=0.2 --set time.end=2e-4 " + settings;
  const Outcome check = place.porosph("check " + arguments);
  REQUIRE(check.status == 0);
  REQUIRE(place.porosph("run " + arguments + " --out results --threads 1").status == 0);
  const double estimate = number_after(check.out, "memory +about "),
               peak = summary(place, "results")["peak_memory_bytes"].get<double>() / 1e6;
  CAPTURE(estimate, peak);
  CHECK(estimate < 1.5 * peak);
  CHECK(estimate > peak / 1.5);
}

TEST_CASE("the estimate of time knows that the run ends at rest") {
  const Workplace place;
  place.write("ground.toml", ground("spacing = 0.1", sand, "level = 6"));
  const Outcome check = place.porosph("check ground.toml");
  const double at = number_after(check.out, "until at rest, about [0-9.e+-]+ s, at ");
  REQUIRE(place.porosph("run ground.toml --no-frames --out results").status == 0);
  const double rested = summary(place, "results")["time"];
  CAPTURE(at, rested);
  CHECK(at < 1.5 * rested);
  CHECK(at > rested / 1.5);
}

TEST_CASE("fem tells the probes of soil that consolidates at each time of the output") {
  const Workplace place;
  place.write("clay.toml",
              ground("spacing = 0.5", sand + "\npermeability = 1e-8", "mode = 'coupled'\nlevel = 6") +
                  "[output]\ntimes = [1, 2]\n");
  const std::string settings =
      "--set stop.unbalanced_force_ratio=0 --set loading.damping=0 --set time.end=1e9 --edge 3";
  REQUIRE(place.porosph("fem clay.toml --out fem " + settings).status == 0);
  std::istringstream probes(text_of(place.folder() / "fem" / "probes.csv"));
  std::string line;
  std::getline(probes, line);
  CHECK(line.starts_with("time,probe,x,y,EffectiveStress_XX,"));
  std::vector<std::array<double, 3>> rows;  // time, sigma'_yy, p_w
  while (std::getline(probes, line)) {
    std::smatch found;
    REQUIRE(std::regex_match(line, found,
                             std::regex("([^,]*),A,5,3,[^,]*,([^,]*),[^,]*,[^,]*,([^,]*),[^,]*,[^,]*")));
    rows.push_back({std::stod(found[1]), std::stod(found[2]), std::stod(found[3])});
  }
  REQUIRE(rows.size() == 4);
  const double total = -20e3 * 3, standing = -9810 * 3;
  CHECK(rows[0][0] == 0);
  for (const auto& [time, effective, pore] : rows) CHECK(effective + pore == Approx(total));
  const double modulus = 15e6 * 0.7 / (1.3 * 0.4), of_water = 2.2e9 / 0.4;
  CHECK(rows[0][1] == Approx((total - standing) * modulus / (modulus + of_water)).epsilon(1e-3));
  CHECK(rows[3][0] == 1e9);
  CHECK(rows[3][2] == Approx(standing).epsilon(1e-6));
}

TEST_CASE("water beside a dam's upright face bends it as finite elements say") {
  const Workplace place;
  const std::string dam =
      "title = 'Dam'\n[particles]\nspacing = 0.25\n[[soil]]\nname = 'dam'\npolygon = [[0, 0], [4, 0], [4, "
      "10], [0, 10]]\n"
      "youngs_modulus = 100e6\npoissons_ratio = 0.2\nunit_weight_saturated = 24e3\n[[water.stretches]]\nx_to "
      "= 0\n"
      "level = 9\n[[boundary]]\nkind = 'fixed'\nfrom = [0, 0]\nto = [4, 0]\n[loading]\ndamping = "
      "'adaptive'\n[time]\n"
      "end = 20\ncourant = 0.5\n[stop]\nunbalanced_force_ratio = 1e-4\n[[probe]]\nname = 'top'\nposition = "
      "[2, 9.5]\n";
  place.write("dam.toml", dam);
  REQUIRE(place.porosph("run dam.toml --no-frames --out results").status == 0);
  REQUIRE(place.porosph("fem dam.toml --out fem").status == 0);
  const double moved = summary(place, "results")["probes"]["top"]["values"]["Displacement_X"];
  std::smatch found;
  const std::string probes = text_of(place.folder() / "fem" / "probes.csv");
  REQUIRE(std::regex_search(probes, found, std::regex("\ntop,(?:[^,]*,){7}([^,]*),")));
  const double reference = std::stod(found[1]);
  CAPTURE(moved, reference);
  CHECK(reference == Approx(0.0467).epsilon(0.002));  // beam theory, bending and shear: 46 mm
  CHECK(moved == Approx(reference).epsilon(0.05));    // 12 % at 0.5 m, 3.8 % at 0.2 m
  place.write("sliver.toml", std::regex_replace(dam, std::regex("x_to = 0"), "x_to = 0.05"));
  REQUIRE(place.porosph("run sliver.toml --no-frames --out sliver").status == 0);
  CHECK(summary(place, "sliver")["probes"]["top"]["values"]["Displacement_X"].get<double>() ==
        Approx(moved).epsilon(0.01));
}
