// Periodic sides: the soil goes on behind each as it begins at the other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/case/case_file.hpp"
#include "solver/run/drainage.hpp"
#include "solver/run/simulation.hpp"
#include "solver/sph/dynamics.hpp"
#include "tests/step_by_hand.hpp"
#include "tests/strip.hpp"

using namespace porosph;

namespace {

/// Weightless, without a base.
Case strip_in_space(Arrangement arrangement) {
  Case scene = periodic_strip(8, 10);
  scene.boundaries.erase(scene.boundaries.begin());  // the base
  scene.particles.arrangement = arrangement;
  scene.particles.disorder = arrangement == Arrangement::disordered ? 0.2 : 0;
  scene.loading.gravity_applied = false;
  return scene;
}

bool has(const std::vector<Vec2>& points, const Vec2& p) {
  return std::ranges::any_of(points, [&](const Vec2& q) { return (p - q).norm() < 1e-12; });
}

}  // namespace

TEST_CASE("behind a periodic side lies what is at the other, also once soil has moved beyond it",
          "[boundary][periodic]") {
  const std::vector<Vec2> soil = {{0.2, 1}, {2, 1}, {3.8, 1}};
  const std::vector<Wall> walls = make_walls(
      {{BoundaryKind::periodic, {0, 0}, {0, 2}}, {BoundaryKind::periodic, {4, 0}, {4, 2}}}, soil, 1);
  for (const double moved : {0.0, 0.5, -0.7}) {
    std::vector<Vec2> points = soil;
    for (Vec2& p : points) p.x() += moved;
    const std::vector<Vec2> there = points;
    std::vector<Image> images;
    append_images(walls, 0, 2, 1, points, images);
    REQUIRE(has(points, there[0] + Vec2(4, 0)));
    REQUIRE(has(points, there[2] - Vec2(4, 0)));
    for (std::size_t i = 0; i < images.size(); ++i) {  // each once, and no copy of a copy
      REQUIRE(images[i].parent < 3);
      REQUIRE(std::ranges::count_if(points,
                                    [&](const Vec2& q) { return (q - points[3 + i]).norm() < 1e-9; }) == 1);
    }
  }
  for (const Wall& wall : walls) CHECK(wall.reflection().isIdentity(0));
}

TEST_CASE("a strip that is sheared evenly has one stress to round-off, and no force inside",
          "[boundary][periodic]") {
  const Arrangement arrangement = GENERATE(Arrangement::lattice, Arrangement::disordered);
  const Case scene = strip_in_space(arrangement);
  Model model = build_model(scene);
  const auto dynamics = make_dynamics(scene.formulation, model);
  constexpr double rate = 1e-3, dt = 1;
  Particles& p = model.particles;
  dynamics->prepare();
  for (std::size_t a = 0; a < p.size(); ++a) p.velocity[a] = {rate * p.position[a].y(), 0};
  dynamics->strain(dt);
  const double expected = model.soils[0].shear_modulus() * rate * dt;
  double off = 0, force = 0;
  std::vector<Vec2> acceleration(p.size());
  for (Vec2& v : p.velocity) v.setZero();
  dynamics->accelerations(acceleration);
  for (std::size_t a = 0; a < p.size(); ++a) {
    off = std::max(off, std::abs(p.stress[a].xy / expected - 1));
    const double y = p.start[a].y(), reach = 5 * scene.smoothing_length();
    if (y < reach || y > 10 * 0.5 - reach) continue;
    force = std::max(force, acceleration[a].norm() * p.density[a] * model.spacing / expected);
  }
  CHECK(off < 1e-10);
  CHECK(force < (arrangement == Arrangement::lattice ? 1e-12 : 1e-2));
}

TEST_CASE("periodic sides conserve momentum", "[boundary][periodic]") {
  Case scene = strip_in_space(Arrangement::disordered);
  scene.time.end = 0.2;
  scene.time.courant = 0.5;
  scene.soils[0].velocity = {0.3, 0};
  scene.soils[0].angular_velocity = 0.05;
  Simulation s(scene);
  const auto momentum = [&] {
    Vec2 sum = Vec2::Zero();
    for (std::size_t a = 0; a < s.model().particles.size(); ++a)
      sum += s.model().particles.mass[a] * s.model().particles.velocity[a];
    return sum;
  };
  const Vec2 before = momentum();
  while (s.step() < s.last_step() && !s.instability()) s.advance();
  REQUIRE(!s.instability());
  CHECK((momentum() - before).norm() < 1e-11 * before.norm());
}

TEST_CASE("water flows through periodic sides as through the soil inside", "[boundary][periodic][water]") {
  Case scene = periodic_strip(8, 10);
  scene.soils[0].permeability = {2e-5, 1e-5};
  const bool moved = GENERATE(false, true);
  const Model model = build_model(scene);
  Particles p = model.particles;
  if (moved)
    for (std::size_t a = 0; a < p.size(); ++a) p.position[a].x() += 0.3 * p.position[a].y() / 5;
  const std::vector<HydraulicFaceCase> faces = {{.kind = FaceKind::closed}};
  HydraulicOutline outline = hydraulic_outline(scene.soils, faces, model.spacing, scene.boundaries);
  const DarcyFlow flow =
      moved ? DarcyFlow(make_flow_pairs_of_moved(scene.soils, outline, p, model.spacing), outline,
                        std::vector<Retention>(1), p.soil, std::vector<double>(p.size(), -1e9))
            : saturated_flow(scene.soils, outline, p, model.spacing);
  SparseRows slope;
  std::vector<double> head(p.size()), inflow(p.size());
  const double wave = 2 * std::numbers::pi / 4;
  for (std::size_t a = 0; a < p.size(); ++a) head[a] = std::cos(wave * p.start[a].x() + 0.3);
  flow.assemble(head, FaceConditions(outline, faces, true), DarcyFlow::Slope::secant, slope, inflow);
  // Each row of particles is turned into itself by a shift of one: a wave is an eigenvector to round-off.
  double of_row = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    if (std::abs(p.start[a].y() - 2.25) > 1e-6) continue;
    const double found = inflow[a] / (head[a] * p.volume(a));
    if (of_row == 0) of_row = found;
    CHECK(found == Approx(of_row).epsilon(1e-10));
  }
  CHECK(of_row == Approx(-2e-5 * wave * wave).epsilon(moved ? 0.15 : 0.1));
}

TEST_CASE("a layer between periodic sides consolidates as between rollers", "[boundary][periodic][water]") {
  const auto settlement = [](BoundaryKind sides) {
    Case scene = periodic_strip(4, 8);
    for (BoundaryCase& b : scene.boundaries)
      if (b.kind == BoundaryKind::periodic) b.kind = sides;
    scene.soils[0].permeability = {1e-6, 1e-6};
    scene.soils[0].youngs_modulus = 100e6;
    scene.particles.smoothing_ratio = 1;
    scene.formulation.zero_energy_control = 0.05;
    scene.water.mode = WaterMode::coupled;
    scene.water.stretches = {{-never, never, 4.5}};
    scene.time.courant = 0.9;
    scene.time.end = 1000;
    Simulation s(scene);
    while (s.step() < s.last_step() && !s.instability()) s.advance();
    if (s.instability()) FAIL(s.instability()->message);
    double lowest = 0;
    for (std::size_t a = 0; a < s.model().particles.size(); ++a)
      lowest = std::min(lowest, s.model().particles.displacement(a).y());
    return lowest;
  };
  const double between_rollers = settlement(BoundaryKind::roller);
  CHECK(between_rollers < -1e-5);
  CHECK(settlement(BoundaryKind::periodic) == Approx(between_rollers).epsilon(3e-4));
}
