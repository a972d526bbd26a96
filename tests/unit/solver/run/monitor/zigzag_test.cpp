#include "solver/run/monitor/zigzag.hpp"

#include <catch2/catch.hpp>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr double spacing = 0.5;

/// A box of 24 x 12 particles after a displacement u(x, y).
template <class Displacement>
Zigzag after(Displacement&& u) {
  Model model = build_model(box_of_soil(24, 12, spacing));
  for (Vec2& x : model.particles.position) x += u(x);
  return measure_zigzag(model);
}

double alternating(const Vec2& x) { return static_cast<int>(x.y() / spacing) % 2 == 0 ? 1 : -1; }

}  // namespace

TEST_CASE("the zigzag of rows that alternate is their amplitude") {
  const double amplitude = 1e-3;
  const Zigzag z = after([&](const Vec2& x) { return Vec2(0, amplitude * alternating(x)); });
  CHECK(z.largest == Approx(amplitude).epsilon(0.01));
  CHECK(z.rms > 0.3);
}

TEST_CASE("displacements that are quadratic, or a rotation, have no zigzag") {
  CHECK(after([](const Vec2& x) { return Vec2(1e-3 * x.x() * x.y(), -2e-3 * x.y() * x.y()); }).largest <
        1e-12);
  CHECK(after([](const Vec2& x) { return Vec2(-0.2 * x.y(), 0.2 * x.x()); }).largest < 1e-12);
}

TEST_CASE("soil that has flowed has no zigzag to speak of, what rests below it keeps its own") {
  const double amplitude = 1e-3;
  const auto flowed = [&](const Vec2& x) {
    const double above = std::max(0.0, x.y() - 3);
    return Vec2(8 * above + 0.3 * std::sin(40 * x.x()) * above, x.y() < 3 ? amplitude * alternating(x) : 0);
  };
  CHECK(after(flowed).largest == Approx(amplitude).epsilon(0.05));
}
