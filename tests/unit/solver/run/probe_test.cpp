#include "solver/run/probe.hpp"

#include <catch2/catch.hpp>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

Model disordered_body() {
  Case scene = box_of_soil(10, 8);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.3;
  return build_model(scene);
}

double linear(double offset, const Vec2& x) { return offset + 3 * x.x() - 7 * x.y(); }

}  // namespace

TEST_CASE("a probe reads linear fields exactly, at corners and outside of the particles too",
          "[simulation]") {
  Model model = disordered_body();
  const Vec2 at = GENERATE(Vec2(2.1, 1.9), Vec2(0, 0), Vec2(5, 1.3));
  const Probe probe({"A", at}, model);
  Particles& p = model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Vec2 x = p.start[a];
    p.stress[a] = {linear(1, x), linear(2, x), linear(3, x), linear(4, x)};
    p.pore_pressure[a] = linear(5, x);
    p.position[a] = x + Vec2(linear(6, x), linear(7, x));
  }
  const std::vector<double> values = probe.read(p).values();
  REQUIRE(values.size() == probe_quantities().size());
  for (std::size_t q = 0; q < values.size(); ++q)
    CHECK(values[q] == Approx(linear(1.0 + static_cast<double>(q), at)).epsilon(1e-11).margin(1e-10));
  CHECK(probe.name() == "A");
  CHECK(probe.start() == at);
}

TEST_CASE("a probe moves with the soil", "[simulation]") {
  Model model = disordered_body();
  Particles& p = model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) p.stress[a].yy = linear(0, p.start[a]);
  const Probe probe({"A", {2, 2}}, model);
  for (Vec2& x : p.position) x += Vec2(30, -1);
  const Reading reading = probe.read(p);
  CHECK(reading.stress.yy == Approx(linear(0, {2, 2})));
  CHECK((reading.displacement - Vec2(30, -1)).norm() < 1e-11);
}

TEST_CASE("a probe away from all soil is refused by name", "[simulation]") {
  CHECK_THROWS_WITH(Probe({"far", {50, 2}}, disordered_body()), Catch::Contains("probe 'far'"));
}

TEST_CASE("weights of particles in a row are the kernel's mean", "[simulation]") {
  const std::vector<double> w = linear_weights({0, 0}, {{-0.1, 0}, {0.1, 0}, {0.2, 0}}, {1, 1, 1}, 0.3);
  CHECK(w[0] + w[1] + w[2] == Approx(1));
  CHECK(w[0] == Approx(w[1]));
  CHECK(w[2] < w[1]);
}
