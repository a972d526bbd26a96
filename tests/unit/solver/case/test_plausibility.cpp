// Values that are allowed, but can hardly be meant.
#include <catch2/catch.hpp>
#include <tuple>

#include "solver/case/plausibility.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// Level ground of 10 m x 6 m.
Case ground(double youngs_modulus, double saturated, double level = -1) {
  Case scene = box_of_soil(20, 12);
  hold_as_column(scene);
  scene.soils[0].youngs_modulus = youngs_modulus;
  scene.soils[0].unit_weight_saturated = scene.soils[0].unit_weight_unsaturated = saturated;
  if (level >= 0) add_water(scene, level);
  return scene;
}

/// Dry ground with the Young's modulus that lets it settle by this share of its thickness.
Case ground_that_settles_by(double share) {
  const double nu = 0.33, modulus = 20e3 * 6 / 2 / share;
  return ground(modulus * (1 + nu) * (1 - 2 * nu) / (1 - nu), 20e3);
}

/// Ground of sand without cohesion, of a law that yields.
Case ground_that_yields(LawKind law = LawKind::mohr_coulomb) {
  Case scene = ground(15e6, 20e3);
  scene.soils[0].law = law;
  scene.soils[0].strength.friction_angle = 30;
  return scene;
}

std::string only(const std::vector<std::string>& warnings) {
  REQUIRE(warnings.size() == 1);
  return warnings[0];
}

}  // namespace

TEST_CASE("what is plausible is not warned of") {
  CHECK(doubtful_values(ground(15e6, 20e3)).empty());
  CHECK(doubtful_values(ground(15e6, 20e3, 6)).empty());
  CHECK(doubtful_values(ground(5e6, 11e3, 3)).empty());
}

TEST_CASE("settlement by own weight is that of one-dimensional compression") {
  const Case dry = ground(15e6, 20e3);
  const double nu = 0.33, modulus = 15e6 * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  CHECK(settlement_by_own_weight(dry).compression == Approx(20e3 * 6 / 2 / modulus));
  const Case wet = ground(15e6, 20e3, 8);
  CHECK(settlement_by_own_weight(wet).compression == Approx((20e3 - 9810) * 6 / 2 / modulus));
  Case half = ground(15e6, 20e3, 3);
  half.soils[0].unit_weight_unsaturated = 18e3;
  const double above = 18e3 * 3, below = (20e3 - 9810) * 3;
  CHECK(settlement_by_own_weight(half).compression ==
        Approx((above / 2 * 3 + (above + below / 2) * 3) / modulus / 6));
  Case layers = dry;  // 1 m of soft soil under 5 m
  layers.soils.push_back(layers.soils[0]);
  layers.soils[0].polygon = box_outline(0, 1, 10, 6);
  layers.soils[1].polygon = box_outline(0, 0, 10, 1);
  layers.soils[1].youngs_modulus = 1.5e6;
  const Settlement s = settlement_by_own_weight(layers);
  CHECK(s.soil == 1);
  CHECK(s.compression == Approx(20e3 * 5.5 / (modulus / 10)));
  layers.loading.gravity_applied = false;
  CHECK(settlement_by_own_weight(layers).compression == 0);
}

TEST_CASE("a Young's modulus that cannot carry the soil is named, with the unit that was meant") {
  CHECK_THAT(only(doubtful_values(ground(15e3, 20e3))),
             Contains("soil[0].youngs_modulus = 15000 Pa lets soil 'soil' settle by about 270 %") &&
                 Contains("it looks like a value in kPa: 15000 kPa is 15e6 Pa"));
  CHECK_THAT(only(doubtful_values(ground(15, 20e3))), Contains("15 MPa is 15e6 Pa"));
  const std::string soft = only(doubtful_values(ground(0.5e6, 20e3)));
  CHECK_THAT(soft, Contains("settle by about 8.1 % of its thickness") && !Contains("looks like"));
}

TEST_CASE("the least settlements that are named, that look like a unit and that break a run") {
  CHECK(doubtful_values(ground_that_settles_by(0.0499)).empty());
  CHECK_THAT(only(doubtful_values(ground_that_settles_by(0.0501))), Contains("settle by about 5.0 %"));
  CHECK_THAT(only(doubtful_values(ground_that_settles_by(0.499))), !Contains("looks like"));
  CHECK_THAT(only(doubtful_values(ground_that_settles_by(0.501))), Contains("looks like a value in kPa"));
  CHECK_THAT(usual_cause_of_breakdown(ground_that_settles_by(0.199)), !Contains("too soft"));
  CHECK_THAT(usual_cause_of_breakdown(ground_that_settles_by(0.201)), Contains("too soft for its weight"));
}

TEST_CASE("unit weights in other units are named, with what was meant") {
  CHECK_THAT(
      only(doubtful_values(ground(15e6, 20))),
      Contains("soil[0].unit_weight_saturated = 20 N/m3 looks like a value in kN/m3: 20 kN/m3 is 20e3 N/m3"));
  CHECK_THAT(only(doubtful_values(ground(15e6, 2000))), Contains("2000 kg/m3 is 19.62e3 N/m3"));
  Case water = ground(15e6, 20e3, 6);
  water.water.unit_weight = 9.81;
  CHECK_THAT(only(doubtful_values(water)),
             Contains("water.unit_weight = 9.81 N/m3 looks like a value in kN/m3"));
  Case above = ground(15e6, 20e3);
  above.soils[0].unit_weight_unsaturated = 18;
  CHECK_THAT(only(doubtful_values(above)), Contains("soil[0].unit_weight_unsaturated = 18 N/m3"));
}

TEST_CASE("weights look like another unit between the lightest and the heaviest soil") {
  for (const auto& [lightest, heaviest, unit] : {std::tuple{1.0, 40.0, "looks like a value in kN/m3"},
                                                 {900.0, 4000.0, "looks like a value in kg/m3"}}) {
    CAPTURE(unit);
    CHECK(doubtful_values(ground(15e6, 0.99 * lightest)).empty());
    CHECK_THAT(only(doubtful_values(ground(15e6, lightest))), Contains(unit));
    CHECK_THAT(only(doubtful_values(ground(15e6, heaviest))), Contains(unit));
    CHECK(doubtful_values(ground(15e6, 1.01 * heaviest)).empty());
  }
}

TEST_CASE("a strength that bears less than a thousandth of the soil's weight looks like kPa") {
  const bool clay = GENERATE(true, false);
  const auto warnings = [&](double value) {
    Case scene = ground_that_yields(clay ? LawKind::tresca : LawKind::mohr_coulomb);
    StrengthCase& strength = scene.soils[0].strength;
    (clay ? strength.undrained_strength : strength.cohesion) = value;
    return doubtful_values(scene);
  };
  const std::string key = clay ? "soil[0].undrained_strength" : "soil[0].cohesion";
  CHECK(warnings(0.99).empty());
  CHECK_THAT(only(warnings(1)), Contains(key + " = 1 Pa") && Contains("1 kPa is 1000 Pa"));
  CHECK_THAT(only(warnings(119.9)), Contains(key));  // 6 m of 20 kN/m3 weigh 120 kPa
  CHECK(warnings(120.1).empty());
}

TEST_CASE("a K0 beyond Rankine's limits is named, in soil without cohesion") {
  const auto warnings = [](double k0, double cohesion = 0) {
    Case scene = ground_that_yields();
    scene.loading.k0_stress = true, scene.loading.k0 = k0;
    scene.soils[0].strength.cohesion = cohesion;
    return doubtful_values(scene);
  };
  CHECK_THAT(only(warnings(0.333)), Contains("bears K0 from 0.333 to 3, but K0 is 0.333"));
  CHECK(warnings(1 / 3.0).empty());
  CHECK(warnings(3).empty());
  CHECK_THAT(only(warnings(3.001)), Contains("soil[0].friction_angle = 30 degrees"));
  CHECK(warnings(3.001, 1e3).empty());
  Case by_itself = ground_that_yields();  // nu / (1 - nu)
  by_itself.loading.k0_stress = true;
  by_itself.soils[0].poissons_ratio = 0.2501;
  CHECK(doubtful_values(by_itself).empty());
  by_itself.soils[0].poissons_ratio = 0.2499;
  CHECK_THAT(only(doubtful_values(by_itself)), Contains("the soil yields in the first step"));
}

TEST_CASE("shear bands narrower than a spacing are named") {
  Case scene = ground_that_yields();
  StrengthCase& strength = scene.soils[0].strength;
  strength.softening_length = 0.49;
  CHECK(doubtful_values(scene).empty());
  strength.softening = SofteningKind::linear;
  CHECK_THAT(only(doubtful_values(scene)),
             Contains("soil[0].softening_length = 0.49 m is less than particles.spacing = 0.5 m"));
  strength.softening_length = 0.5;
  CHECK(doubtful_values(scene).empty());
}

TEST_CASE("soil that floats is named where it is wet") {
  CHECK_THAT(
      only(doubtful_values(ground(15e6, 9000, 3))),
      Contains(
          "soil[0].unit_weight_saturated = 9000 N/m3 is not above water's 9810 N/m3: soil 'soil' floats"));
  CHECK(doubtful_values(ground(15e6, 9000)).empty());
}

TEST_CASE("soils of one or two rows are named, also where they are bent") {
  Case thin = ground(15e6, 20e3);
  thin.soils[0].polygon = box_outline(0, 0, 10, 0.76);
  CHECK_THAT(only(doubtful_values(thin)), Contains("two rows"));
  thin.soils[0].polygon = box_outline(0, 0, 10, 0.6);
  CHECK_THAT(only(doubtful_values(thin)), Contains("soil 'soil' is 0.6 m thick, one row of particles with "
                                                   "particles.spacing = 0.5 m") &&
                                              Contains("three rows need 0.2 m"));
  thin.soils[0].polygon = box_outline(0, 0, 10, 1.24);
  CHECK_THAT(only(doubtful_values(thin)), Contains("two rows"));
  thin.soils[0].polygon = box_outline(0, 0, 10, 1.26);
  CHECK(doubtful_values(thin).empty());
  thin.soils[0].polygon = {{0, 0}, {8, 4}, {16, 4}, {16, 4.7}, {7.8, 4.7}, {0, 0.8}};  // a blanket on a slope
  CHECK(typical_thickness(thin.soils[0]) == Approx(0.7).epsilon(0.03));
  CHECK_THAT(only(doubtful_values(thin)), Contains("one row"));
  thin.soils[0].polygon = box_outline(0, 0, 4, 4);
  CHECK(typical_thickness(thin.soils[0]) == Approx(4));
}

TEST_CASE("the area below water is exact") {
  SoilCase soil;
  soil.polygon = {{0, 0}, {10, 0}, {10, 2}, {0, 6}};
  soil.holes = {box_outline(1, 1, 2, 2)};
  WaterCase water;
  CHECK(area_of(soil, water).whole == Approx(39));
  CHECK(area_of(soil, water).wet == 0);
  water.stretches = {{.level = 1.5}};
  CHECK(area_of(soil, water).wet == Approx(14.5));
  water.stretches = {{.x_from = 0, .x_to = 4, .level = 1.5}, {.x_from = 5, .x_to = 20, .level = 1}};
  CHECK(area_of(soil, water).wet == Approx(4 * 1.5 - 0.5 + 5));
}

TEST_CASE("what broke a run is named by what the case has wrong") {
  CHECK_THAT(usual_cause_of_breakdown(ground(15e3, 20e3)),
             Contains("youngs_modulus = 15000 Pa") && Contains("kPa"));
  Case fast = ground(15e6, 20e3);
  fast.time.courant = 1.5;
  CHECK_THAT(usual_cause_of_breakdown(fast), Contains("time.courant = 1.5"));
  CHECK_THAT(usual_cause_of_breakdown(ground(15e6, 20e3)),
             Contains("youngs_modulus") && Contains("known to be stable"));
  Case contrast = ground(15e6, 20e3);
  contrast.soils.push_back(contrast.soils[0]);
  contrast.soils[1].youngs_modulus = 15e9;
  contrast.time.courant = 0.81;
  CHECK_THAT(usual_cause_of_breakdown(contrast),
             Contains("1e+03 times as stiff") && Contains("0.8 in place of 0.81"));
  contrast.time.courant = 0.8;
  CHECK_THAT(usual_cause_of_breakdown(contrast), Contains("known to be stable"));
  contrast.time.courant = 0.81, contrast.soils[1].youngs_modulus = 14.9e9;
  CHECK_THAT(usual_cause_of_breakdown(contrast), Contains("known to be stable"));
  Case suction = ground(15e6, 20e3, 11);
  suction.formulation.motion = Motion::conventional;
  CHECK_THAT(usual_cause_of_breakdown(suction), Contains("conventional") && Contains("suction"));
}
