#include "solver/case/units.hpp"
#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

namespace {

double value(std::string_view text, std::string_view unit) {
  const Measure read = read_measure(text, unit);
  CAPTURE(text, unit, read.fault);
  REQUIRE(read.fault.empty());
  return read.value;
}

}  // namespace

TEST_CASE("decimal units shift the point, and lose no digit", "[units]") {
  CHECK(value("15 MPa", "Pa") == 15e6);
  CHECK(value("20 kN/m3", "N/m3") == 20e3);
  CHECK(value("0.7 cm", "m") == 0.007);
  CHECK(value("3mm", "m") == 0.003);
  CHECK(value("1.1e-3 GPa", "Pa") == 1.1e6);
  CHECK(value("-2.5e+1 kPa", "Pa") == -25e3);
  CHECK(value("35 deg", "degrees") == 35);
  CHECK(value("35°", "degrees") == 35);
  CHECK(value("3 kPa/m", "Pa/m") == 3000);
  CHECK(value("3 kN/m3", "Pa/m") == 3000);  // one dimension
  CHECK(value("18 kN/m^3", "N/m3") == 18e3);
  CHECK(value("18 kN*m^-3", "N/m3") == 18e3);
  CHECK(value("18 kN·m^-3", "N/m3") == 18e3);
  CHECK(value("5 kN/m²", "Pa") == 5e3);
  CHECK(value("30 %", "") == 0.3);
  CHECK(value("1 1/cm", "1/m") == 100);
}

TEST_CASE("other units are converted", "[units]") {
  CHECK(value("2 h", "s") == 7200);
  CHECK(value("1.5 d", "s") == 129600);
  CHECK(value("36 mm/h", "m/s") == Approx(1e-5).epsilon(1e-15));
  CHECK(value("0.61086523819801535 rad", "degrees") == Approx(35).epsilon(1e-15));
  CHECK(value("180 deg/s", "rad/s") == Approx(3.14159265358979324).epsilon(1e-15));
  CHECK(value("10 ft", "m") == Approx(3.048).epsilon(1e-15));
  CHECK(value("1 psf", "Pa") == Approx(47.88025898033584).epsilon(1e-14));
  CHECK(value("1 psi", "Pa") == Approx(6894.757293168361).epsilon(1e-14));
  CHECK(value("100 pcf", "N/m3") == Approx(15708.746).epsilon(1e-7));
  CHECK(value("1 kg/s2/m", "Pa") == 1);
}

TEST_CASE("a value that does not measure the dimension is an error", "[units]") {
  CHECK(read_measure("15", "Pa").fault ==
        "must be a number in Pa, or text of a number and a unit; allowed are Pa, kPa, MPa, GPa, bar, kN/m2, "
        "psi, psf");
  CHECK(
      read_measure("15 m", "Pa").fault ==
      "has the unit 'm', which does not convert to Pa; allowed are Pa, kPa, MPa, GPa, bar, kN/m2, psi, psf");
  CHECK(read_measure("15 mpa", "Pa").fault ==
        "has the unit 'mpa', which is not known; allowed are Pa, kPa, MPa, GPa, bar, kN/m2, psi, psf");
  CHECK(read_measure("1 m", "").fault ==
        "has the unit 'm', which does not convert to a pure number; allowed are %");
  for (const char* text : {"", " ", "m", "- 3 m", "1 m/", "1 /m", "1 m//s", "1 m^", "1 m99", "1e m",
                           "1.2.3 m", "1e99999 m", "nan m", "inf m", "1 m m", "0x3 m", "1 m-", "1 ^2"}) {
    CAPTURE(text);
    CHECK_FALSE(read_measure(text, "m").fault.empty());
  }
}

TEST_CASE("a case in engineers' units is the same case", "[units]") {
  const std::string text = with("youngs_modulus = 1e6", "youngs_modulus = \"1 MPa\"");
  const std::vector<std::string> in_units{"soil.0.unit_weight_saturated=20 kN/m3",
                                          "time.end=\"1 s\"",
                                          "particles.spacing=50 cm",
                                          "boundary.0.to=[\"400 cm\", 0]",
                                          "soil.0.poissons_ratio=30 %",
                                          "loading.damping=2 %",
                                          "water.level_over_time=[[0, \"3 m\"], [\"1 min\", \"350 cm\"]]"};
  const std::vector<std::string> plain{"loading.damping=0.02", "water.level_over_time=[[0, 3], [60, 3.5]]"};
  const Case given = parse_case(text, "box.toml", in_units);
  CHECK(write_case(given) == write_case(parse_case(small_case, "box.toml", plain)));
  CHECK_THAT(write_case(given), Contains("youngs_modulus = 1000000"));
}

TEST_CASE("errors of units name file, line, key and value", "[units]") {
  CHECK(errors_of(with("end = 1", "end = \"1 kPa\"")) ==
        "box.toml:19:7: key 'time.end' = \"1 kPa\": has the unit 'kPa', which does not convert to s; allowed "
        "are s, ms, min, h, d, yr");
  CHECK(errors_of(with("youngs_modulus = 1e6", "youngs_modulus = \"-1 kPa\"")) ==
        "box.toml:9:18: key 'soil[0].youngs_modulus' = \"-1 kPa\": must be > 0 and <= 1e+15 Pa");
  CHECK(errors_of(small_case, {"loading.damping=2 m"}) ==
        "override 'loading.damping=2 m': key 'loading.damping' = \"2 m\": has the unit 'm', which does not "
        "convert to a pure number; allowed are %");
  CHECK(errors_of(small_case, {"water.level_over_time=[[0, 3], [\"1 m\", 4]]"}) ==
        "override 'water.level_over_time=[[0, 3], [\"1 m\", 4]]': key 'water.level_over_time[1][0]' = \"1 "
        "m\": has the unit 'm', which does not convert to s; allowed are s, ms, min, h, d, yr");
}

TEST_CASE("every unit that is offered can be read", "[units]") {
  for (const char* unit : {"m", "s", "Pa", "N/m3", "Pa/m", "m/s", "m/s2", "degrees", "rad/s", "1/m", ""}) {
    const std::string units = usual_units(unit);
    CAPTURE(unit);
    REQUIRE_FALSE(units.empty());
    for (std::size_t at = 0; at < units.size();) {
      const std::size_t end = std::min(units.find(", ", at), units.size());
      CHECK(read_measure("1 " + units.substr(at, end - at), unit).fault.empty());
      at = end + 2;
    }
  }
}
