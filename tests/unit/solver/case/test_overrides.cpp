#include "tests/unit/solver/case/case_text.hpp"

using namespace porosph;
using namespace porosph::test;

namespace {

const std::string probed =
    small_case + "[[probe]]\nname = 'A'\nposition = [1, 1]\n[[probe]]\nname = 'B'\nposition = [2, 1]\n";

Case with_overrides(const std::vector<std::string>& overrides) {
  return parse_case(probed, "box.toml", overrides);
}
std::string errors(const std::string& override_text) { return errors_of(probed, {override_text}); }

}  // namespace

TEST_CASE("overrides replace values and add tables") {
  const Case c =
      with_overrides({"formulation.motion=proposed", "soil.0.youngs_modulus=1e7", "probe.B.position=[3, 2]",
                      "water.level = 3", "title=Two words", "output.fields=[\"Mass\"]", "time.end=2",
                      "time.end=3", "soil.sand.no_tension=true"});
  CHECK(c.formulation.motion == Motion::proposed);
  CHECK(c.soils[0].youngs_modulus == 1e7);
  CHECK(c.soils[0].no_tension);
  CHECK(c.probes[0].position == Point(1, 1));
  CHECK(c.probes[1].position == Point(3, 2));
  CHECK(c.water.stretches.at(0).level == 3);
  CHECK(c.title == "Two words");
  CHECK(c.output.fields == std::vector<std::string>{"Mass"});
  CHECK(c.time.end == 3);
}

TEST_CASE("lists of tables are replaced as a whole") {
  const Case c = with_overrides({"probe=[{name='C', position=[1, 0.5]}]", "probe.C.position=[2, 0.5]"});
  REQUIRE(c.probes.size() == 1);
  CHECK(c.probes[0].name == "C");
  CHECK(c.probes[0].position == Point(2, 0.5));
}

TEST_CASE("errors name the override that brings them") {
  CHECK(
      errors("soil.0.youngs_modulus=-3") ==
      "override 'soil.0.youngs_modulus=-3': key 'soil[0].youngs_modulus' = -3: must be > 0 and <= 1e+15 Pa");
  CHECK(errors("water.lvl=3") ==
        "override 'water.lvl=3': key 'water': needs one of 'level', 'stretches' and 'level_over_time'\n"
        "override 'water.lvl=3': key 'water.lvl' = 3: is not known; did you mean 'level'?");
  CHECK(
      errors("probe=[{name='C', pos=1}]") ==
      "override 'probe=[{name='C', pos=1}]': key 'probe[0].position': is missing: Position at the start; the "
      "probe "
      "then moves "
      "with the soil.\n"
      "override 'probe=[{name='C', pos=1}]': key 'probe[0].pos' = 1: is not known; known are name, position");
  CHECK(errors("probe.B.name=A") ==
        "override 'probe.B.name=A': key 'probe[1].name' = \"A\": is the name of probe[0] too");
  CHECK(errors("soil.0.polygon=[[0,0],[4,2],[4,0],[0,2]]") ==
        "override 'soil.0.polygon=[[0,0],[4,2],[4,0],[0,2]]': key 'soil[0].polygon': crosses or touches "
        "itself at (2, 1)");
  // An error elsewhere in a table that an override touches is still the file's.
  CHECK(errors_of(with("youngs_modulus = 1e6", "youngs_modulus = 0"), {"soil.0.poissons_ratio=0.2"}) ==
        "box.toml:9:18: key 'soil[0].youngs_modulus' = 0: must be > 0 and <= 1e+15 Pa");
}

TEST_CASE("overrides that cannot be understood") {
  CHECK(errors("time.end") == "override 'time.end': must be key=value");
  CHECK(errors("time..end=1") ==
        "override 'time..end=1': the key must be a dotted path, as particles.spacing");
  CHECK(errors("=1") == "override '=1': the key must be a dotted path, as particles.spacing");
  CHECK(errors("time.end=[1").starts_with("override 'time.end=[1': the value is not TOML: "));
  CHECK(errors("time.end=").starts_with("override 'time.end=': the value is not TOML: "));
  CHECK(errors("time.end=1\nb=2") == "override 'time.end=1\nb=2': the value must be one line");
  CHECK(errors("time.end.x=1") == "override 'time.end.x=1': 'time.end' is not a table");
  CHECK(errors("probe.C.name=D") ==
        "override 'probe.C.name=D': there is no probe 'C'; the case has 'A', 'B'");
  CHECK(errors("probe.2.name=D") ==
        "override 'probe.2.name=D': there is no probe '2'; the case has 'A', 'B'");
  CHECK(errors("probe.A=1") == "override 'probe.A=1': 'probe' is a list: name one of it ('A', 'B')");
}
