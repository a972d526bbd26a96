// Soil that bears no tension, and closes before it bears again.
#include "solver/soil/no_tension.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace porosph;

namespace {

const NoTension soil = NoTension::from_young(15e6, 0.33);

Stress strained(const Stress& old, double xx, double yy, NoTension::History& q) {
  return soil.step(old, Gradient((Mat2() << xx, 0, 0, yy).finished()), 1, q);
}

}  // namespace

TEST_CASE("a soil without tension has no stress where the mean would be tensile", "[soil]") {
  NoTension::History q;
  const Stress pulled = soil.step(Stress{5e4, -1e4, 2e4, 3e4}, Gradient(), 1e-3, q);
  CHECK(pulled.in_plane().isZero(0));
  CHECK(pulled.zz == 0);
  CHECK(q.opening == Approx(2e4 / soil.bulk_modulus));

  NoTension::History closed;
  const Stress pressed = soil.step(Stress{-5e4, 1e4, -2e4, 3e4}, Gradient(), 1e-3, closed);
  CHECK(pressed.xx == -5e4);
  CHECK(pressed.yy == 1e4);
  CHECK(closed.opening == 0);
}

TEST_CASE("soil that has come apart bears again when it has closed, not before", "[soil]") {
  const double apart = GENERATE(1e-3, 0.02, 0.7);
  CAPTURE(apart);
  NoTension::History q;
  Stress s{};
  for (int step = 0; step < 100; ++step) s = strained(s, 0.005 * apart, 0.005 * apart, q);
  CHECK(q.opening == Approx(apart));
  for (int step = 0; step < 99; ++step) {
    s = strained(s, 0, -0.01 * apart, q);
    REQUIRE(s.in_plane().isZero(0));  // no deviator either
  }
  const double left = q.opening;
  s = strained(s, 0, -left - 1e-4, q);
  CHECK(q.opening == 0);
  CHECK(s.mean() == Approx(-1e-4 * soil.bulk_modulus));
}

TEST_CASE("what is never pulled is elastic to the bit", "[soil]") {
  NoTension::History q;
  const Elasticity elastic = soil;
  const Gradient gradient((Mat2() << -0.3, 0.2, 0.1, -0.4).finished());
  const Stress old{-5e4, -6e4, -4e4, 1e4}, a = soil.step(old, gradient, 1e-3, q),
                                           b = elastic.elastic_step(old, gradient, 1e-3);
  CHECK(a.in_plane() == b.in_plane());
  CHECK(a.zz == b.zz);
}
