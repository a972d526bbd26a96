#include "solver/reference/exact/consolidation.hpp"

#include <catch2/catch.hpp>

using namespace porosph;

TEST_CASE("Terzaghi's layer has the published pressures and degrees", "[exact][consolidation]") {
  CHECK(terzaghi_pressure(0.25, 0.1) == Approx(0.4238).margin(5e-5));
  CHECK(terzaghi_pressure(0.5, 0.2) == Approx(0.5532).margin(5e-5));
  CHECK(terzaghi_pressure(1, 0.5) == Approx(0.3708).margin(5e-5));
  CHECK(terzaghi_degree(0.19673) == Approx(0.5).margin(1e-5));
  CHECK(terzaghi_degree(0.84809) == Approx(0.9).margin(1e-5));
  CHECK(own_weight_pressure(0.7, 1e-4) == Approx(0.7).margin(1e-3));
}

TEST_CASE("two layers of one soil are one layer, and layers differ as computed elsewhere",
          "[exact][consolidation]") {
  const TwoLayers same({0.5, 1, 1}, {0.5, 1, 1}, 1);
  for (const double time : {0.05, 0.3}) {
    CHECK(same.pressure(0.25, time) == Approx(terzaghi_pressure(0.25, time)).epsilon(1e-9));
    CHECK(same.pressure(0.8, time) == Approx(terzaghi_pressure(0.8, time)).epsilon(1e-9));
    CHECK(same.degree(time) == Approx(terzaghi_degree(time)).epsilon(1e-5));
  }
  const TwoLayers open_above({0.5, 1, 1}, {0.5, 0.1, 1}, 1), tight_above({0.5, 0.1, 1}, {0.5, 1, 1}, 1);
  const double depths[] = {0.25, 0.5, 0.75, 1};
  const double soon[] = {0.3780, 0.6002, 0.9941, 1.0000}, later[] = {0.0482, 0.0938, 0.4680, 0.6147};
  const double soon_tight[] = {0.9229, 0.9998, 1, 1}, later_tight[] = {0.4568, 0.8190, 0.8412, 0.8486};
  for (int i = 0; i < 4; ++i) {
    CHECK(open_above.pressure(depths[i], 0.1) == Approx(soon[i]).margin(6e-5));
    CHECK(open_above.pressure(depths[i], 1) == Approx(later[i]).margin(6e-5));
    CHECK(tight_above.pressure(depths[i], 0.1) == Approx(soon_tight[i]).margin(6e-5));
    CHECK(tight_above.pressure(depths[i], 1) == Approx(later_tight[i]).margin(6e-5));
  }
}

TEST_CASE("two layers a thousand times as tight as each other keep flow and pressure",
          "[exact][consolidation]") {
  const TwoLayers layers({2, 1e-6, 10e6}, {2, 1e-9, 5e6}, 9810);
  const double time = 3e6, d = 1e-5;
  const double above = layers.pressure(2, time) - layers.pressure(2 - d, time);
  const double below = layers.pressure(2 + d, time) - layers.pressure(2, time);
  CHECK(1e-6 * above == Approx(1e-9 * below).epsilon(1e-3));
}

TEST_CASE("Mandel's specimen shows the rise in its middle", "[exact][consolidation]") {
  const Mandel soft(0), usual(0.2);  // over F / a
  const double factors[] = {0.01, 0.05, 0.1, 0.5};
  const double of_soft[] = {1.0590, 1.1365, 1.1518, 0.7027}, of_usual[] = {1.0438, 1.0989, 1.0954, 0.5928};
  for (int i = 0; i < 4; ++i) {
    CHECK(2 * soft.pressure(0, factors[i]) == Approx(of_soft[i]).margin(6e-5));
    CHECK(2 * usual.pressure(0, factors[i]) == Approx(of_usual[i]).margin(6e-5));
  }
  CHECK(2 * usual.pressure(0.5, 0.1) == Approx(0.8609).margin(6e-5));
}

TEST_CASE("Mandel's plate passes on all of its force", "[exact][consolidation]") {
  const Mandel m(0.2);
  for (const double factor : {0.01, 0.1, 1.0}) {
    double force = 0;
    for (int i = 0; i < 1000; ++i) force += m.vertical_stress((i + 0.5) / 1000, factor) / 1000;
    CHECK(force == Approx(1).epsilon(1e-4));
  }
  CHECK(m.strain(30) == Approx(0.8).epsilon(1e-9));  // 1 - nu
  CHECK(m.strain(1e-5) == Approx(0.5).margin(0.01));
}
