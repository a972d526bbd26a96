// porosph profile, and the colours of plastic strain, of a run that a user made.
#include <catch2/catch.hpp>

#include "tests/app/porosph.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

TEST_CASE("the surface of soil and how far it went are drawn, written and said") {
  const Workplace place;
  const std::string collapse =
      "run '" POROSPH_SOURCE_DIR
      "/cases/collapse/square.toml' --quiet --threads 1 --set particles.spacing=0.01 "
      "--set time.end=0.2 ";
  REQUIRE(place.porosph(collapse + "--out run").status == 0);
  const Outcome outcome = place.porosph("profile run --time all");
  REQUIRE(outcome.err == "");
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("t = 0 s at 0 s: 95 % of the soil up to x = 0.095 m") &&
                              Contains("mean x 0.05 m, 0.01 m2") && Contains("run/profile.png"));
  CHECK_THAT(text_of(place.folder() / "run/profile.csv"), Contains("run,time,x,surface,thickness"));
  CHECK(place.porosph("profile run run --out two.svg").status == 0);
  CHECK(place.porosph("profile run --out two.gif").status == 2);

  // Logarithmic unless asked otherwise, or given a range that holds zero.
  const auto picture = [&](const std::string& options) {
    CHECK(place.porosph("render run --field PlasticStrain --out p.svg " + options).status == 0);
    return text_of(place.folder() / "p.svg");
  };
  const std::string usual = picture("");
  CHECK(usual == picture("--scale logarithmic"));
  CHECK(usual != picture("--scale linear"));
  CHECK(picture("--range 0,100") == picture("--range 0,100 --scale linear"));
  CHECK(place.porosph("render run --field PlasticStrain --range 0,100 --scale logarithmic").status == 2);
}
