#include "solver/water/transient_water.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

#include "solver/case/case_file.hpp"
#include "solver/run/kept_state.hpp"
#include "solver/water/steady_water.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/unit/solver/water/scenes.hpp"

using namespace porosph;
using namespace porosph::test;

namespace {

Case over_time(double width, double height, double spacing) {
  Case scene = seepage_box(width, height, spacing);
  scene.water.mode = WaterMode::transient;
  scene.soils[0].porosity = 0.4;
  scene.soils[0].retention = {.model = RetentionModel::van_genuchten, .alpha = 2, .n = 2, .residual = 0.05};
  return scene;
}

/// The water of a case, and where its particles are.
struct Flow {
  explicit Flow(const Case& scene) : particles(build_model(scene).particles), water(scene, particles) {}
  void run(double until) {
    while (now < until) now = water.advance(now, until);
    water.tell();
  }
  double now = 0;
  Particles particles;
  TransientWater water;
};

double farthest_apart(std::span<const double> a, std::span<const double> b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("water at rest stays at rest, above its table too", "[water]") {
  Case scene = over_time(1, 2, 0.1);
  scene.water.transient.start_level = 0.7;
  scene.water.faces.push_back(head_face({0, 0}, {0, 2}, 0.7));
  Flow flow(scene);
  flow.run(86400);
  for (const double h : flow.water.richards().head()) CHECK(h == Approx(0.7).epsilon(1e-9));
  CHECK(flow.water.richards().balance().entered < 1e-12);
}

TEST_CASE("seepage over time becomes steady", "[water]") {
  Case scene = over_time(2, 1, 0.1);
  scene.water.transient.start_level = 0.5;
  scene.water.faces.push_back(head_face({0, 0}, {0, 1}, 0.9));
  scene.water.faces.push_back(head_face({2, 0}, {2, 1}, 0.3));
  scene.sections = {{.name = "middle", .from = {1.02, -1}, .to = {1.02, 2}}};
  Flow flow(scene);
  flow.run(1e9);
  Case steady = scene;
  steady.water.mode = WaterMode::steady;
  const SteadyWater there(steady, flow.particles);
  CHECK(farthest_apart(flow.water.richards().head(), there.record()->head) < 1e-6);
  CHECK(std::abs(flow.water.richards().balance().error()) < 1e-8);
  // What passes the middle is what enters on the left and leaves on the right.
  CHECK(there.record()->through_sections[0] == Approx(there.record()->through_faces[1]).epsilon(1e-7));
  CHECK(there.record()->through_sections[0] == Approx(-there.record()->through_faces[2]).epsilon(1e-7));
}

TEST_CASE("a level that rises and falls fills the soil and drains it in few steps", "[water]") {
  const auto [alpha, n, k] = GENERATE(std::tuple(0.8, 1.09, 5e-8), std::tuple(3.6, 1.56, 3e-6),
                                      std::tuple(2.0, 2.0, 1e-5), std::tuple(14.5, 2.68, 8e-5));
  CAPTURE(alpha, n);
  Case scene = over_time(1, 2, 0.1);
  scene.soils[0].permeability = {k, k};
  scene.soils[0].retention.alpha = alpha, scene.soils[0].retention.n = n;
  scene.water.transient.start_level = 0.7;  // psi = 0 to rounding in a row of particles
  HydraulicFaceCase side = head_face({0, 0}, {0, 2}, HydraulicFaceCase::unset);
  side.level_over_time = {{0, 0.7}, {3600, 1.5}, {86400, 1.5}, {90000, 0.3}};
  scene.water.faces.push_back(side);
  scene.water.faces.push_back({.kind = FaceKind::seepage, .from = {0, 2}, .to = {1, 2}});
  Flow flow(scene);
  flow.run(86400);
  CHECK(flow.water.record()->through_faces[2] <= 1e-15);  // nothing enters a seepage face
  flow.run(10 * 86400);
  CHECK(flow.water.record()->through_faces[1] < 0);
  CHECK(flow.water.record()->through_faces[2] <= 1e-15);
  CHECK(std::abs(flow.water.richards().balance().error()) < 1e-8);
  CHECK(flow.water.richards().counts().steps < 2000);  // the coarse sand takes about 1000
}

TEST_CASE("water that finds no room is reported with its place and time", "[water]") {
  Case scene = over_time(1, 2, 0.25);
  scene.water.transient.start_level = 3;  // full
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  scene.water.faces = {{.kind = FaceKind::closed}};
  scene.water.faces.push_back({.kind = FaceKind::flux, .from = {0, 0}, .to = {1, 0}, .rate = 1e-6});
  Flow flow(scene);
  CHECK_THROWS_WITH(flow.run(3600), Catch::StartsWith("seepage over time does not converge at 0.0") &&
                                        Catch::Contains(" s around (0.") &&
                                        Catch::Contains("in steps down to 0.0086 s"));
}

TEST_CASE("the level of a face that changes is felt at its time", "[water]") {
  Case scene = over_time(0.4, 2, 0.1);
  scene.water.transient.start_level = 2.5;
  scene.soils[0].retention = {};
  HydraulicFaceCase base = head_face({0, 0}, {0.4, 0}, HydraulicFaceCase::unset);
  base.level_over_time = {{0, 2.5}, {1000, 3.5}};
  scene.water.faces.push_back(base);  // closed elsewhere: the head follows it
  scene.water.coupling.bulk_modulus = CouplingCase::incompressible;
  Flow flow(scene);
  flow.run(500);
  for (const double h : flow.water.richards().head()) CHECK(h == Approx(3.0).epsilon(1e-6));
  flow.run(4000);
  for (const double h : flow.water.richards().head()) CHECK(h == Approx(3.5).epsilon(1e-6));
}

TEST_CASE("rain enters as it falls, also on a slope by its plan", "[water]") {
  Case scene = over_time(2, 1, 0.1);
  scene.soils[0].polygon = {{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}};
  scene.water.transient.start_level = 0.2;
  scene.water.transient.start_pressure_head = -0.8;
  for (const auto& [from, to] : {std::pair<Point, Point>({0, 2}, {1, 2}), {{1, 2}, {2, 1}}})
    scene.water.faces.push_back({.kind = FaceKind::rain, .from = from, .to = to, .rate = 1e-7});
  Flow flow(scene);
  flow.run(36000);
  const Richards::Balance balance = flow.water.richards().balance();
  CHECK(balance.entered == Approx(2 * 1e-7 * 36000).epsilon(1e-9));
  CHECK(balance.gained == Approx(balance.entered).epsilon(1e-7));
}

TEST_CASE("evaporation falls where the face has dried up", "[water]") {
  Case scene = over_time(0.4, 1, 0.05);
  scene.water.transient.start_pressure_head = -1;
  scene.water.faces.push_back(
      {.kind = FaceKind::rain, .from = {0, 1}, .to = {0.4, 1}, .rate = -1e-7, .driest = -20});
  Flow flow(scene);
  flow.run(3600);
  CHECK(flow.water.richards().balance().left == Approx(0.4 * 1e-7 * 3600).epsilon(1e-9));
  flow.run(4e6);
  CHECK(flow.water.record()->through_faces[1] > -0.4 * 1e-7 * 0.5);
  CHECK(flow.water.record()->through_faces[1] < 0);
  for (std::size_t a = 0; a < flow.particles.size(); ++a)
    CHECK(flow.water.richards().head()[a] - flow.particles.position[a].y() > -20 - 1e-6);
}

TEST_CASE("a drain takes what flows to it", "[water]") {
  Case scene = seepage_box(1, 2, 0.1);
  scene.water.mode = WaterMode::steady;
  scene.water.faces.push_back(head_face({0, 2}, {1, 2}, 2.5));
  scene.water.drains = {{.name = "drain", .from = {0, 0.95}, .to = {1, 0.95}, .level = 1.5}};
  const SteadyWater water(scene, build_model(scene).particles);
  const double k = scene.soils[0].permeability.x();
  CHECK(water.record()->through_faces[1] == Approx(k * 1.0 / 1.05).epsilon(1e-6));
  CHECK(water.record()->through_faces[2] == Approx(-k * 1.0 / 1.05).epsilon(1e-6));
  for (std::size_t a = 0; a < water.record()->head.size(); ++a) CHECK(water.record()->head[a] >= 1.5 - 1e-9);
}

TEST_CASE("soil that follows a flow continues from a kept state to the same bits", "[water]") {
  Case scene = over_time(1, 2, 0.2);
  scene.formulation = default_formulation(Motion::consistent);
  scene.water.transient.start_level = 0.7;
  scene.water.faces.push_back(head_face({0, 0}, {1, 0}, 0.7));
  scene.water.faces.back().level = HydraulicFaceCase::unset;
  scene.water.faces.back().level_over_time = {{0, 0.7}, {3600, 1.5}};
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {1, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 2});
  add_wall(scene, BoundaryKind::roller, {1, 0}, {1, 2});
  scene.time.end = 7200, scene.output.interval = 3600;
  const auto to_the_end = [](Simulation& s) {
    while (s.step() < s.last_step() && !s.instability()) s.advance();
  };
  Simulation first(scene);
  first.begin();
  for (int k = 0; k < 5; ++k) first.advance();  // between two times of the output
  REQUIRE(first.time() < 3600);
  const KeptState kept(first);
  to_the_end(first);
  Simulation second(scene);
  kept.restore(second);
  to_the_end(second);
  CHECK(second.step() == second.last_step());
  CHECK(std::ranges::equal(second.seepage()->richards().head(), first.seepage()->richards().head()));
  CHECK(second.seepage()->richards().balance().entered == first.seepage()->richards().balance().entered);
  CHECK(second.model().particles.position == first.model().particles.position);
  CHECK(second.model().particles.uncounted == first.model().particles.uncounted);
  CHECK(second.model().particles.pore_pressure == first.model().particles.pore_pressure);
  CHECK(first.largest_displacement() > 1e-6);  // water lifts it
}
