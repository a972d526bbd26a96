// Paths of all laws against closed forms, to 1e-8 of the path.
#include "solver/element/element_test.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/element/key_numbers.hpp"

using namespace porosph;

namespace {

constexpr double radian = std::numbers::pi / 180, tight = 1e-8;
const Elasticity elastic = Elasticity::from_young(20e6, 0.3);
const double young = 20e6, nu = 0.3;

ElementSetup setup_of(ElementTest test, double pressure, double strain, int steps = 400) {
  return {
      .test = test, .axial_stress = pressure, .radial_stress = pressure, .targets = {strain}, .steps = steps};
}

double number(const ElementPath& path, const std::string& name) {
  for (const KeyNumber& k : key_numbers(path))
    if (k.name == name) return k.value;
  FAIL("no key number " << name);
  return 0;
}

/// The larger principal stress at failure over a smaller one s3, compression positive [Pa].
double mohr_coulomb_limit(double s3, double c, double phi) {
  const double kp = std::pow(std::tan((45 + phi / 2) * radian), 2);
  return kp * s3 + 2 * c * std::sqrt(kp);
}
double axial(const ElementState& s) { return -s.stress.yy; }
double radial(const ElementState& s) { return -s.stress.xx; }

/// Elastic and perfectly plastic: the law of the elastic line until its end, compared along the whole path.
void check_bilinear(const ElementPath& path, double stiffness, double limit) {
  const double scale = std::abs(limit);
  for (const ElementState& s : path.states) {
    const double line = stiffness * path.strain(s);
    const double expected = limit > 0 ? std::min(line, limit) : std::max(line, limit);
    REQUIRE(path.deviator(s) == Approx(expected).margin(tight * scale));
  }
  CHECK(std::abs(stiffness * path.strain(path.states.back())) > scale);  // it did yield
}

}  // namespace

TEST_CASE("elastic soil answers every test with its moduli", "[element]") {
  const AnyLaw law = LinearElastic::from_young(young, nu);
  const double p0 = 100e3, k = elastic.bulk_modulus, g = elastic.shear_modulus,
               m = elastic.constrained_modulus();
  const auto run = [&](ElementTest test) { return run_element_test(law, setup_of(test, p0, 1e-3)); };
  for (const ElementState& s : run(ElementTest::isotropic).states)
    REQUIRE(s.mean_pressure() == Approx(p0 + k * s.volume_compression()).epsilon(tight));
  const ElementPath oedometer = run(ElementTest::oedometer);
  for (const ElementState& s : oedometer.states) {
    REQUIRE(axial(s) == Approx(p0 - m * s.strain.yy).epsilon(tight));
    REQUIRE(radial(s) == Approx(p0 - nu / (1 - nu) * m * s.strain.yy).epsilon(tight));
    REQUIRE(s.strain.xx == 0);
  }
  CHECK(number(oedometer, "oedometer modulus at the start") == Approx(m).epsilon(tight));
  for (const ElementTest test : {ElementTest::triaxial_drained, ElementTest::extension_drained}) {
    const ElementPath path = run(test);
    for (const ElementState& s : path.states) {
      REQUIRE(radial(s) == Approx(p0).epsilon(1e-12));
      REQUIRE(axial(s) == Approx(p0 - young * s.strain.yy).epsilon(tight));
      REQUIRE(s.strain.xx == Approx(-nu * s.strain.yy).margin(tight * 1e-3));
    }
    CHECK((path.states.back().strain.yy > 0) == (test == ElementTest::extension_drained));
  }
  for (const ElementTest test : {ElementTest::triaxial_undrained, ElementTest::extension_undrained}) {
    const ElementPath path = run(test);
    for (const ElementState& s : path.states) {
      REQUIRE(path.deviator(s) == Approx(-3 * g * s.strain.yy).margin(tight * 3 * g * 1e-3));
      REQUIRE(s.mean_pressure() == Approx(p0).epsilon(tight));
      // Total radial stress stays, so the pore pressure takes a third of the deviator.
      REQUIRE(s.pore_pressure == Approx(path.deviator(s) / 3).margin(tight * p0));
    }
  }
  for (const ElementState& s : run(ElementTest::biaxial_drained).states) {
    REQUIRE(axial(s) == Approx(p0 - young / (1 - nu * nu) * s.strain.yy).epsilon(tight));
    REQUIRE(-s.stress.zz == Approx(p0 + nu * (axial(s) - p0)).epsilon(tight));
  }
  for (const ElementTest test : {ElementTest::simple_shear_drained, ElementTest::simple_shear_undrained})
    for (const ElementState& s : run(test).states) {
      REQUIRE(s.stress.xy == Approx(2 * g * s.strain.xy).margin(tight * g * 1e-3));
      REQUIRE(axial(s) == Approx(p0).epsilon(tight));
    }
}

TEST_CASE("Mohr and Coulomb's soil fails where its circle touches the line, in every test", "[element]") {
  const auto [c, phi, psi] =
      GENERATE(table<double, double, double>({{0, 30, 0}, {5e3, 25, 0}, {10e3, 35, 10}, {2e3, 20, 20}}));
  const double p0 = GENERATE(20e3, 100e3);
  CAPTURE(c, phi, psi, p0);
  const AnyLaw law = MohrCoulomb::from_angles(elastic, c, phi, psi);
  const auto run = [&](ElementTest test) { return run_element_test(law, setup_of(test, p0, 0.1)); };
  const double above = mohr_coulomb_limit(p0, c, phi);
  const double kp = std::pow(std::tan((45 + phi / 2) * radian), 2),
               below = std::max((p0 - 2 * c * std::sqrt(kp)) / kp, -c / std::tan(phi * radian));
  check_bilinear(run(ElementTest::triaxial_drained), young, above - p0);
  check_bilinear(run(ElementTest::extension_drained), young, below - p0);
  const ElementPath biaxial = run(ElementTest::biaxial_drained);
  for (const ElementState& s : biaxial.states)
    REQUIRE(axial(s) == Approx(std::min(p0 - young / (1 - nu * nu) * s.strain.yy, above)).epsilon(tight));
  if (c == 0) CHECK(number(biaxial, "peak friction angle") == Approx(phi).epsilon(1e-6));
  // The plastic part of the strain dilates by sin(psi) of its shear.
  const ElementState &end = biaxial.states.back(), &before = biaxial.states[biaxial.states.size() - 2];
  const double volume = end.strain.trace() - before.strain.trace(),
               shear = (end.strain.xx - end.strain.yy) - (before.strain.xx - before.strain.yy);
  CHECK(volume == Approx(std::sin(psi * radian) * shear).margin(1e-8 * shear));
  if (psi > 0) return;
  // Without dilation p' stays at constant volume: in triaxial compression and extension q = 6 (p sin + c
  // cos) / (3 -+ sin), in plane strain and simple shear t = p sin + c cos, p of the two in-plane stresses.
  const double sine = std::sin(phi * radian), strength = 6 * (p0 * sine + c * std::cos(phi * radian));
  check_bilinear(run(ElementTest::triaxial_undrained), 3 * elastic.shear_modulus, strength / (3 - sine));
  check_bilinear(run(ElementTest::extension_undrained), 3 * elastic.shear_modulus, -strength / (3 + sine));
  for (const ElementTest test : {ElementTest::biaxial_undrained, ElementTest::simple_shear_undrained}) {
    const ElementPath path = run(test);
    CHECK(number(path, "undrained shear strength") == Approx(strength / 6).epsilon(tight));
    CHECK(path.states.back().largest_mean() == Approx(p0).epsilon(tight));
  }
}

TEST_CASE("an oedometer test yields where the elastic stress ratio is below Rankine's", "[element]") {
  // Loaded from no stress sigma_r = nu / (1 - nu) sigma_a: with nu = 0.2 or 0.3 that is less than Ka of 20
  // degrees.
  const double phi = 20, ka = 1 / std::pow(std::tan((45 + phi / 2) * radian), 2);
  const double ratio = GENERATE(0.2, 0.3, 0.4);
  CAPTURE(ratio);
  const Elasticity e = Elasticity::from_young(young, ratio);
  const ElementPath path =
      run_element_test(MohrCoulomb::from_angles(e, 0, phi), setup_of(ElementTest::oedometer, 0, 0.01));
  const double at_rest = std::max(ratio / (1 - ratio), ka);
  for (const ElementState& s : path.states)
    REQUIRE(radial(s) == Approx(at_rest * axial(s)).margin(tight * 100e3));
  CHECK(number(path, "radial over axial stress at the end") == Approx(at_rest).epsilon(tight));
  // Yielding without dilation leaves the volume to the bulk modulus alone: (1 + 2 Ka) / 3 of sigma_a.
  const double modulus =
      ratio / (1 - ratio) < ka ? 3 * e.bulk_modulus / (1 + 2 * ka) : e.constrained_modulus();
  CHECK(number(path, "oedometer modulus at the end") == Approx(modulus).epsilon(tight));
}

TEST_CASE("Drucker and Prager's soil fails on its cone", "[element]") {
  const auto [c, phi, psi] =
      GENERATE(table<double, double, double>({{0, 30, 0}, {5e3, 25, 0}, {10e3, 20, 8}}));
  const double p0 = 80e3;
  CAPTURE(c, phi, psi);
  const DruckerPrager cone = DruckerPrager::from_mohr_coulomb(elastic, c, phi, psi);
  const auto run = [&](ElementTest test, double strain) {
    return run_element_test(cone, setup_of(test, p0, strain, 2000));
  };
  // q / sqrt(3) = k + 3 alpha p with p = p0 + q / 3, q of either sign.
  const double a = cone.alpha, k = cone.k, root = std::sqrt(3.0);
  check_bilinear(run(ElementTest::triaxial_drained, 0.1), young, (k + 3 * a * p0) / (1 / root - a));
  const double extended = (k + 3 * a * p0) / (1 / root + a);
  check_bilinear(run(ElementTest::extension_drained, 0.1), young, -extended);
  // In plane strain the cone has Mohr and Coulomb's strength, once the stress across has settled.
  const ElementPath biaxial = run(ElementTest::biaxial_drained, 0.2);
  CHECK(axial(biaxial.states.back()) == Approx(mohr_coulomb_limit(p0, c, phi)).epsilon(tight));
  if (psi > 0) return;
  check_bilinear(run(ElementTest::triaxial_undrained, 0.1), 3 * elastic.shear_modulus,
                 root * (k + 3 * a * p0));
  CHECK(number(run(ElementTest::simple_shear_undrained, 0.1), "peak shear stress") ==
        Approx(p0 * std::sin(phi * radian) + c * std::cos(phi * radian)).epsilon(tight));
}

TEST_CASE("undrained clay bears its strength at any pressure, and that of its depth", "[element]") {
  Tresca law{elastic};
  law.strength = 15e3, law.growth = 2e3, law.level = 3;
  const double depth = GENERATE(0.0, 4.0), strength = 15e3 + 2e3 * depth;
  for (const double p0 : {0.0, 50e3, 200e3}) {
    for (const ElementTest test : {ElementTest::triaxial_undrained, ElementTest::extension_undrained,
                                   ElementTest::biaxial_undrained, ElementTest::simple_shear_undrained}) {
      ElementSetup setup = setup_of(test, p0, 0.05);
      setup.place = Vec2(1, 3 - depth);
      const ElementPath path = run_element_test(law, setup);
      CHECK(number(path, "undrained shear strength") == Approx(strength).epsilon(tight));
      CHECK(path.states.back().largest_shear_stress() == Approx(strength).epsilon(tight));
    }
  }
}

TEST_CASE("softening soil falls along its law of plastic strain", "[element]") {
  // At constant volume tau = G (gamma - gamma_p) = c left(gamma_p / sqrt(3)); linear softening is solved for
  // gamma_p. Laws soften by the strain before a step, so a path is a step behind: first order.
  const double c = 20e3, rest = 5e3, g = elastic.shear_modulus, rate = 20, gamma = 0.06;
  const MohrCoulomb clay = MohrCoulomb::from_angles(elastic, c, 0).softened_to(rest, 0, {0, rate});
  const double slope = (c - rest) * rate / std::numbers::sqrt3, plastic = (g * gamma - c) / (g - slope);
  const double exact = c - slope * plastic;
  std::array<double, 2> error{};
  for (const int k : {0, 1}) {
    const ElementPath path = run_element_test(
        clay, setup_of(ElementTest::simple_shear_undrained, 50e3, gamma, k == 0 ? 1000 : 2000));
    for (std::size_t i = 1; i < path.states.size(); ++i) {
      const double before = path.states[i - 1].history[0],
                   strength = rest + (c - rest) * std::max(1 - rate * before, 0.0);
      REQUIRE(path.states[i].stress.xy ==
              Approx(std::min(strength, g * 2 * path.states[i].strain.xy)).epsilon(tight));
    }
    error[k] = path.states.back().stress.xy - exact;
  }
  CHECK(std::abs(error[1]) < 0.005 * exact);
  CHECK(error[0] / error[1] == Approx(2).epsilon(0.01));
  // Far beyond, the residual strength is left, by Drucker and Prager's law as well.
  const DruckerPrager cone = DruckerPrager::from_mohr_coulomb(elastic, c, 20).softened_to(rest, 10, {40, 0});
  const ElementPath path = run_element_test(cone, setup_of(ElementTest::simple_shear_undrained, 50e3, 3));
  CHECK(path.states.back().stress.xy ==
        Approx(50e3 * std::sin(10 * radian) + rest * std::cos(10 * radian)).epsilon(tight));
  CHECK(number(path, "peak shear stress") > 1.5 * path.states.back().stress.xy);
}

TEST_CASE("soil is unloaded and loaded again, and tests with several pressures give c and phi", "[element]") {
  const double c = 8e3, phi = 28;
  const AnyLaw law = MohrCoulomb::from_angles(elastic, c, phi, 3);
  ElementSetup setup = setup_of(ElementTest::triaxial_drained, 60e3, 0);
  setup.targets = {0.03, 0.029, 0.04};
  const ElementPath path = run_element_test(law, setup);
  REQUIRE(path.states.size() == 1 + 3 * 400u);
  const double q = mohr_coulomb_limit(60e3, c, phi) - 60e3;
  CHECK(path.deviator(path.states[400]) == Approx(q).epsilon(tight));
  CHECK(path.deviator(path.states[800]) == Approx(q - young * 1e-3).epsilon(tight));
  CHECK(path.deviator(path.states[1200]) == Approx(q).epsilon(tight));

  std::vector<ElementPath> paths;
  for (const double p0 : {50e3, 100e3, 200e3})
    paths.push_back(run_element_test(law, setup_of(ElementTest::triaxial_drained, p0, 0.1)));
  const auto strength = strength_of_peaks({&paths[0], &paths[1], &paths[2]});
  REQUIRE(strength);
  CHECK(strength->cohesion == Approx(c).epsilon(1e-6));
  CHECK(strength->friction_angle == Approx(phi).epsilon(1e-6));
  CHECK_FALSE(strength_of_peaks({&paths[0]}));
}

TEST_CASE("a stress can be reached in place of a strain", "[element]") {
  const AnyLaw law = LinearElastic::from_young(young, nu);
  const bool confined = GENERATE(true, false);
  ElementSetup setup = setup_of(confined ? ElementTest::oedometer : ElementTest::isotropic, 50e3, 300e3, 7);
  setup.by_stress = true;
  const ElementPath path = run_element_test(law, setup);
  CHECK(axial(path.states.back()) == Approx(300e3).epsilon(1e-12));
  CHECK(path.states.back().volume_compression() ==
        Approx(250e3 / (confined ? elastic.constrained_modulus() : elastic.bulk_modulus)).epsilon(tight));
}

TEST_CASE("stress that soil cannot bear is an error", "[element]") {
  // Held at 40 kPa across, loaded by nothing along: outside the surface from the start.
  ElementSetup setup = setup_of(ElementTest::triaxial_drained, 0, 0.01);
  setup.radial_stress = -40e3;
  CHECK_THROWS_AS(run_element_test(MohrCoulomb::from_angles(elastic, 0, 30), setup), NoEquilibrium);
}
