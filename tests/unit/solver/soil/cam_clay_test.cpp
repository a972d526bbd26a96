// Modified Cam-clay against its closed forms.
#include "solver/soil/cam_clay.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "solver/element/key_numbers.hpp"

using namespace porosph;

namespace {

constexpr double tight = 1e-8;

CamClay clay(double ratio = 0.9, double attraction = 1e3) {
  CamClay law{Elasticity::from_young(1e9, 0.25)};
  law.ratio = ratio;
  law.compressibility = 0.2 / 2.2, law.swelling = 0.04 / 2.2, law.void_ratio = 1.2;
  law.shear_ratio = 3 * (1 - 2 * 0.25) / (2 * (1 + 0.25));
  law.attraction = attraction;
  return law;
}

ElementSetup setup_of(ElementTest test, double pressure, std::vector<double> targets, int steps = 2000) {
  return {
      .test = test, .axial_stress = pressure, .radial_stress = pressure, .targets = targets, .steps = steps};
}

double number(const ElementPath& path, const std::string& name) {
  for (const KeyNumber& k : key_numbers(path))
    if (k.name == name) return k.value;
  FAIL("no key number " << name);
  return 0;
}

/// P and Pc of a state [Pa].
double shifted(const CamClay& law, const ElementState& s) { return s.mean_pressure() + law.attraction; }
double size_of(const CamClay& law, const ElementState& s) { return s.history[3] + law.attraction; }

}  // namespace

TEST_CASE("the exponential in plain arithmetic is that of the library", "[soil]") {
  for (double x = -40; x <= 40; x += 0.137) {
    CHECK(exponential(x) == Approx(std::exp(x)).epsilon(1e-13).margin(1e-15));
    CHECK(exponential_less_one(1e-9 * x) == Approx(std::expm1(1e-9 * x)).epsilon(1e-14));
  }
}

TEST_CASE("Cam-clay follows its virgin and its swelling line", "[soil]") {
  const double over = GENERATE(1.0, 3.0), p0 = 100e3;
  CamClay law = clay();
  law.overconsolidation = over;
  const ElementPath path = run_element_test(law, setup_of(ElementTest::isotropic, p0, {0.2, 0.17, 0.25}, 50));
  const double start = p0 + law.attraction;
  // Elastic until Pc, and from there along the virgin line; back and forth along a swelling line.
  const double at_yield = law.swelling * std::log(over);
  const auto virgin = [&](double strain) {
    return start * over * std::exp((strain - at_yield) / law.compressibility);
  };
  for (std::size_t i = 0; i < path.states.size(); ++i) {
    const ElementState& s = path.states[i];
    const double strain = s.volume_compression();
    const double top = virgin(0.2), swollen = top * std::exp((strain - 0.2) / law.swelling);
    const double expected = i <= 50 && strain < at_yield ? start * std::exp(strain / law.swelling)
                            : i <= 50 || strain > 0.2    ? virgin(strain)
                                                         : swollen;
    REQUIRE(shifted(law, s) == Approx(expected).epsilon(tight));
    REQUIRE(s.history[2] == Approx(2.2 * std::exp(-strain) - 1).epsilon(tight));
  }
}

TEST_CASE("undrained Cam-clay ends at the critical state with the strength of its preconsolidation",
          "[soil]") {
  const auto [ratio, over] = GENERATE(table<double, double>({{0.9, 1}, {1.2, 1}, {0.9, 1.5}, {0.8, 6}}));
  const auto test = GENERATE(ElementTest::triaxial_undrained, ElementTest::extension_undrained);
  CAPTURE(ratio, over);
  CamClay law = clay(ratio);
  law.overconsolidation = over;
  const double p0 = 150e3, start = p0 + law.attraction;
  const double part = 1 - law.swelling / law.compressibility;
  const ElementPath path = run_element_test(law, setup_of(test, p0, {0.6}));
  for (const ElementState& s : path.states) {
    const double p = shifted(law, s), eta = path.deviator(s) / p;
    if (std::abs(p / start - 1) < 1e-10) continue;  // elastic: straight up
    REQUIRE(p / start ==
            Approx(std::pow(over * ratio * ratio / (ratio * ratio + eta * eta), part)).epsilon(tight));
  }
  const double end = start * std::pow(over / 2, part);
  CHECK(shifted(law, path.states.back()) == Approx(end).epsilon(1e-6));
  CHECK(std::abs(path.deviator(path.states.back())) == Approx(ratio * end).epsilon(1e-6));
  if (over < 2) CHECK(number(path, "undrained shear strength") == Approx(ratio * end / 2).epsilon(1e-6));
  CHECK(path.states.back().history[2] == Approx(1.2).epsilon(tight));
}

TEST_CASE("drained Cam-clay compresses by its lines until the critical state", "[soil]") {
  const double over = GENERATE(1.0, 4.0);
  CamClay law = clay(1.0);
  law.overconsolidation = over;
  const double p0 = 100e3, start = p0 + law.attraction, m = law.ratio;
  const ElementPath path = run_element_test(law, setup_of(ElementTest::triaxial_drained, p0, {1.5}, 8000));
  for (const ElementState& s : path.states) {
    const double p = shifted(law, s), pc = size_of(law, s), q = path.deviator(s);
    REQUIRE(q == Approx(3 * (p - start)).margin(tight * start));  // the radial stress stays
    REQUIRE(q * q / (m * m) + p * (p - pc) <= tight * pc * pc);
    const double strain = (law.compressibility - law.swelling) * std::log(pc / (over * start)) +
                          law.swelling * std::log(p / start);
    REQUIRE(s.volume_compression() == Approx(strain).margin(tight));
  }
  const double end = 3 * start / (3 - m);
  CHECK(shifted(law, path.states.back()) == Approx(end).epsilon(1e-6));
  CHECK(path.deviator(path.states.back()) == Approx(m * end).epsilon(1e-6));
  CHECK(size_of(law, path.states.back()) == Approx(2 * end).epsilon(1e-6));
  // Wet of critical it hardens to there, dry it has a peak and dilates.
  CHECK((number(path, "peak deviator stress q") > 1.02 * m * end) == (over > 2));
}

TEST_CASE("Cam-clay unloads elastically", "[soil]") {
  CamClay law = clay();
  const ElementPath path =
      run_element_test(law, setup_of(ElementTest::triaxial_drained, 100e3, {0.05, 0.0498}));
  const ElementState &turn = path.states[2000], &end = path.states.back();
  const double p0 = shifted(law, turn), p1 = shifted(law, end);
  // The volume by the swelling line; q falls three times as much as p, G / K stays.
  CHECK(end.volume_compression() - turn.volume_compression() ==
        Approx(law.swelling * std::log(p1 / p0)).epsilon(1e-6));
  CHECK(end.history[3] == turn.history[3]);
  const double shear = (end.strain.yy - end.strain.xx - (turn.strain.yy - turn.strain.xx)) * 2 / 3;
  CHECK(shear == Approx(-law.swelling / law.shear_ratio * std::log(p1 / p0)).epsilon(1e-3));
}

TEST_CASE("a step of Cam-clay ends on its surface, whatever it is", "[soil]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int yielded = 0;
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    CamClay law = clay(0.6 + 0.4 * (1 + unit(random)));
    law.preconsolidation = 100e3;
    const double p = 50e3 * (1.001 + unit(random)) * 0.99, q = law.ratio * std::sqrt(p * (101e3 - p)) * 0.9;
    Stress s{-p + 1e3 + q / 3, -p + 1e3 - 2 * q / 3, -p + 1e3 + q / 3, 0};
    CamClay::History h = law.at_start({0, 0}, s);
    const double size = 0.02 * std::pow(10.0, 2 * unit(random) - 2);
    const Gradient g(size * unit(random), size * unit(random), size * unit(random), size * unit(random));
    s = law.step(s, g, 1, h);
    const double now = law.pressure(s), pc = h.preconsolidation + 1e3,
                 root = law.shear_stress(s) * std::sqrt(3.0);
    const double f = (root * root / (law.ratio * law.ratio) + now * (now - pc)) / (pc * pc);
    worst = std::max(worst, f);
    if (std::abs(f) < 1e-10) ++yielded;
  }
  CHECK(worst < 1e-10);
  CHECK(yielded > 2000);
}

TEST_CASE("Cam-clay that has come apart closes before it bears", "[soil]") {
  const CamClay law = clay();
  using Round = GradientIn<Axisymmetric>;
  ElementStress s{-50e3, -50e3, -50e3, 0};
  CamClay::History q = law.start(s);
  const CamClay::History start = q;
  const auto strain = [&](double each) {
    Round g;
    g.xx = g.yy = g.zz = each;
    for (int k = 0; k < 4000; ++k) s = law.step(s, g, 1, q);
  };
  strain(1e-4 / 3);
  const double gap = 0.4 - law.swelling * std::log(51e3 / (1e-3 * law.attraction));
  CHECK(law.pressure(s) == Approx(1e-3 * law.attraction).epsilon(1e-9));
  CHECK(q.opening == Approx(gap).epsilon(1e-3));  // the step in which it comes apart counts to first order
  strain(-1e-4 / 3);
  CHECK(q.opening == 0);
  CHECK(-s.mean() == Approx(50e3).epsilon(0.01));
  CHECK(q.void_ratio == Approx(start.void_ratio).epsilon(1e-4));
}

TEST_CASE("a start beyond the preconsolidation has consolidated the clay", "[soil]") {
  CamClay law = clay();
  law.preconsolidation = 40e3;
  CHECK(law.at_start({0, 0}, {-30e3, -30e3, -30e3, 0}).preconsolidation == 40e3);
  CHECK(law.at_start({0, 0}, {-60e3, -60e3, -60e3, 0}).preconsolidation == Approx(60e3));
  const auto with_shear = law.at_start({0, 0}, {-30e3, -60e3, -30e3, 0});
  CHECK(law.shear_stress<Plane>({-30e3, -60e3, -30e3, 0}) == Approx(30e3 / std::sqrt(3.0)));
  CHECK(with_shear.preconsolidation == Approx(41e3 + 30e3 * 30e3 / (0.81 * 41e3) - 1e3));
}
