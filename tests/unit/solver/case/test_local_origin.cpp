// Coordinates of maps: far from zero, to the same results.
#include <catch2/catch.hpp>

#include "solver/case/local_origin.hpp"
#include "solver/output/fields.hpp"
#include "solver/run/run.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/unit/solver/water/scenes.hpp"

using namespace porosph;
using namespace porosph::test;

namespace {

Case slope() {
  Case scene = box_of_soil(12, 8);
  scene.soils[0].polygon = {{0, 0}, {6, 0}, {6, 1.5}, {4, 2}, {2, 4}, {0, 4}};
  scene.particles.arrangement = Arrangement::stretched;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {6, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 5});
  add_wall(scene, BoundaryKind::roller, {6, 0}, {6, 5});
  scene.water.stretches = {{.x_from = 1.6, .level = 3}};
  scene.probes = {{"A", {2.1, 1.3}}};
  scene.loading.adaptive_damping = true;
  scene.time.end = 0.5;
  return scene;
}

}  // namespace

TEST_CASE("a scene at coordinates of maps gives what it gives at zero") {
  const Case near = slope();
  const Point by(512345.25, 4512345.25);
  const Case far = moved(near, by);
  CHECK(local_origin(near) == Point(0, 0));
  CHECK(local_origin(far) == Point(512345, 4512345));
  Simulation a(near), b(far);
  run(a, {});
  run(b, {});
  REQUIRE(a.model().particles.size() == b.model().particles.size());
  const Reading ra = a.probes()[0].read(a.model().particles), rb = b.probes()[0].read(b.model().particles);
  CHECK(rb.stress.yy == Approx(ra.stress.yy).epsilon(1e-8));
  CHECK(rb.displacement.y() == Approx(ra.displacement.y()).epsilon(1e-8));
  CHECK(rb.pore_pressure == Approx(ra.pore_pressure).epsilon(1e-8));
  const Frame fa = make_frame(a, {}), fb = make_frame(b, {});
  for (std::size_t i = 0; i < fa.points.size(); i += 3) {
    REQUIRE(fb.points[i] - by.x() == Approx(fa.points[i]).margin(1e-8));
    REQUIRE(fb.points[i + 1] - by.y() == Approx(fa.points[i + 1]).margin(1e-8));
  }
}

TEST_CASE("messages name places to the centimetre, also far from zero") {
  Simulation s(moved(slope(), {1e6, 4512345.25}));
  Model model = s.model();
  model.particles.velocity[0] = {1e9, 0};
  const auto breakdown = find_runaway(model, 0);
  REQUIRE(breakdown);
  CHECK_THAT(breakdown->message, Catch::Contains("(from x = 1000000.250 m, y = 4512345.500 m)"));
}

TEST_CASE("what water cannot do is reported with the case's coordinates, not with local ones") {
  Case scene = seepage_box(2, 1, 0.25);
  scene.water.mode = WaterMode::steady;
  Case with_drain = scene;
  with_drain.water.drains = {{.name = "toe", .from = {5, 1}, .to = {5, 1}, .level = 0}};
  const Point by(1e6, 4512345.25);
  CHECK_THROWS_WITH(build_model(moved(scene, by)),
                    Catch::Contains("the soil around (1000000.125, 4512345.375) is reached by no"));
  CHECK_THROWS_WITH(build_model(moved(with_drain, by)), Catch::Contains("'toe' from (1000005, 4512346.25):"));
}
