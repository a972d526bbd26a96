// porosph element as a user runs it.
#include <catch2/catch.hpp>
#include <sstream>

#include "tests/app/porosph.hpp"
#include "tests/unit/render/image.hpp"

using namespace porosph;
using namespace porosph::render;
using Catch::Matchers::Contains;

namespace {

std::string soil_of_strength() {
  std::string text = small_case;
  text.replace(text.find("reference"), 20, "");
  return text.replace(text.find("unit_weight"), 0,
                      "law = \"mohr_coulomb\"\ncohesion = 5e3\nfriction_angle = 30\n");
}

}  // namespace

TEST_CASE("element tests give charts, a table and what a laboratory reads off them") {
  const Workplace place;
  place.write("slope.toml", soil_of_strength());
  const Outcome outcome =
      place.porosph("element slope.toml --pressure 5e4 --pressure 2e5 --steps 50 --out found/tests.png");
  REQUIRE(outcome.err == "");
  REQUIRE(outcome.status == 0);
  // q = 2 sin (p + c cot) / (1 - sin) with sin = 1/2.
  CHECK_THAT(outcome.out, Contains("sand, 50 kPa") && Contains("117.32 kPa") &&
                              Contains("cohesion 5 kPa, friction angle 30 degrees"));
  std::istringstream table(text_of(place.folder() / "found/tests.csv"));
  int lines = 0;
  for (std::string line; std::getline(table, line);) ++lines;
  CHECK(lines == 1 + 2 * 51);
  CHECK(std::filesystem::file_size(place.folder() / "found/tests.png") > 10'000);

  REQUIRE(place
              .porosph("element slope.toml sand --test oedometer --pressure 1e4 --stress 2e5 --stress 5e4 "
                       "--quiet --out o.svg")
              .status == 0);
  CHECK_THAT(text_of(place.folder() / "o.svg"), Contains("<svg"));
  CHECK(text_of(place.folder() / "out") == "");
}

TEST_CASE("element tests that there are not are refused") {
  const Workplace place;
  place.write("slope.toml", soil_of_strength());
  CHECK(place.porosph("element slope.toml --test biaxial-drained --strain nan").status == 2);
  CHECK(place.porosph("element slope.toml --steps 0").status == 2);
  CHECK(place.porosph("element slope.toml --k0 2 --test isotropic").status == 2);
  CHECK(place.porosph("element slope.toml --at 1").status == 2);
  CHECK_THAT(place.porosph("element slope.toml loam").err, Contains("its soils are sand"));
}
