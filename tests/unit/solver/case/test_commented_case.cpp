// A case to start from says all that a case may hold, and is still the same case.
#include "solver/case/case_keys.hpp"
#include "solver/case/commented_case.hpp"
#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;
using Catch::Matchers::Contains;

TEST_CASE("a commented case is the case that it explains") {
  const std::string text = commented_case(small_case + "[[probe]]\nname = 'A'\nposition = [1, 1]\n");
  const Case plain = parse_case(small_case + "[[probe]]\nname = 'A'\nposition = [1, 1]\n", "box.toml");
  CHECK(write_case(parse_case(text, "commented.toml")) == write_case(plain));
  CHECK_THAT(
      text,
      Contains("# Distance of neighbouring particles, dx. [m] Allowed: > 0 and <= 1e+08.\nspacing = 0.5\n"));
  CHECK_THAT(text, Contains("\n#smoothing_ratio = 1\n") && Contains("\n[formulation]\n"));
  CHECK_THAT(text, Contains("# When the run ends. [s]"));
  CHECK_THAT(text, !Contains("seed"));  // used with another arrangement only
}

TEST_CASE("defaults that are taken out of their comments change nothing") {
  std::string text = commented_case(small_case);
  for (const std::string key :
       {"smoothing_ratio", "unit_weight_unsaturated", "zero_energy_control", "courant", "fields"}) {
    const auto at = text.find("\n#" + key + " = ");
    CAPTURE(key);
    REQUIRE(at != std::string::npos);
    text.erase(at + 1, 1);
  }
  CHECK(write_case(parse_case(text, "all.toml")) == write_case(parse_case(small_case, "box.toml")));
}

TEST_CASE("tables of a list are explained once") {
  const std::string text =
      commented_case(small_case + "[[boundary]]\nkind = 'roller'\nfrom = [0, 0]\nto = [0, 2]\n");
  const auto first = text.find("# `roller`: free to slide");
  REQUIRE(first != std::string::npos);
  CHECK(text.find("# `roller`: free to slide", first + 1) == std::string::npos);
}

TEST_CASE("the keys of a case are those that may be set") {
  int found = 0;
  for (const CaseKey& key : case_keys()) {
    if (key.path == "particles.spacing") ++found;
    if (key.path == "soil.0.polygon") ++found;
    if (key.path == "formulation.motion") found += static_cast<int>(key.values.size());
  }
  CHECK(found == 6);
}

TEST_CASE("keys have their units, whatever tables of a list are called") {
  CHECK(unit_of_key("water.level") == "m");
  CHECK(unit_of_key("soil.clay.cohesion") == "Pa");
  CHECK(unit_of_key("soil.2.friction_angle") == "degrees");
  CHECK(unit_of_key("formulation.zero_energy_control") == "-");
  CHECK(unit_of_key("soil.clay.no_such_key") == "-");
}
