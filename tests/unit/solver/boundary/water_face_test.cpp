// Water that presses on a face which it does not enter.
#include "solver/boundary/water_face.hpp"

#include <catch2/catch.hpp>

#include "solver/model/model.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

struct Resultant {
  Vec2 force = Vec2::Zero();  // [N/m]
  double moment = 0;          // about the origin, counter-clockwise [N]
};

Resultant load_on(const Model& model) {
  std::vector<Vec2> a(model.particles.size(), Vec2::Zero());
  add_loads(model.loads, model.particles, 0, a);
  Resultant load;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 f = model.particles.mass[i] * a[i], x = model.particles.position[i];
    load.force += f;
    load.moment += x.x() * f.y() - x.y() * f.x();
  }
  return load;
}

/// A dam of 4 m x 10 m on a fixed base, with its left face at x = 0.
Case dam(Arrangement arrangement, double spacing) {
  Case scene = box_of_soil(1, 1);
  scene.soils[0].polygon = box_outline(0, 0, 4, 10);
  scene.particles.spacing = spacing;
  scene.particles.arrangement = arrangement;
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {4, 0});
  return scene;
}

}  // namespace

TEST_CASE("water beside an upright face presses with its weight, at a third of its depth") {
  const auto arrangement = GENERATE(Arrangement::stretched, Arrangement::surface, Arrangement::lattice);
  const double spacing = GENERATE(0.25, 0.5);
  const double level = GENERATE(9.0, 6.3);
  CAPTURE(static_cast<int>(arrangement), spacing, level);
  Case scene = dam(arrangement, spacing);
  const double force = 9810 * level * level / 2, pieces = 0.002;  // midpoints of pieces at the level

  scene.water.stretches = {{.x_to = 0, .level = level}};
  const Resultant left = load_on(build_model(scene));
  CHECK(left.force.x() == Approx(force).epsilon(pieces));
  CHECK(left.force.y() == Approx(0).margin(1e-9 * force));
  CHECK(left.moment == Approx(-force * level / 3).epsilon(3 * pieces));

  scene.water.stretches = {{.x_from = 4, .level = level}};
  CHECK(load_on(build_model(scene)).force.x() == Approx(-force).epsilon(pieces));
  scene.water.stretches = {{.x_to = 0.05, .level = level}};  // no particle is wet: the same
  if (arrangement != Arrangement::surface)
    CHECK(load_on(build_model(scene)).force.x() == Approx(force).epsilon(pieces));
  scene.water.stretches = {{.x_to = 0, .level = level}, {.x_from = 4, .level = 3}};
  CHECK(load_on(build_model(scene)).force.x() == Approx(force - 9810 * 4.5).epsilon(2 * pieces));
}

TEST_CASE("water that the soil is under presses on no face") {
  Case scene = dam(Arrangement::stretched, 0.5);
  scene.water.stretches = {{.level = 9}};
  CHECK(build_model(scene).loads.empty());
  scene.water.stretches = {{.x_from = -3, .x_to = 8, .level = 9}};
  CHECK(build_model(scene).loads.empty());
  scene.water.stretches = {{.x_to = 4, .level = 9}};  // ends with the soil
  CHECK(build_model(scene).loads.empty());
}

TEST_CASE("a face behind a wall bears no water") {
  Case scene = dam(Arrangement::stretched, 0.5);
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 4});
  scene.water.stretches = {{.x_to = 0, .level = 9}};
  CHECK(load_on(build_model(scene)).force.x() == Approx(9810 * 12.5).epsilon(0.01));
}

TEST_CASE("the pressure stays normal to a face that has turned") {
  Case scene = dam(Arrangement::stretched, 0.5);
  scene.water.stretches = {{.x_to = 0, .level = 12}};
  Model model = build_model(scene);
  const Mat2 turn = (Mat2() << 0.8, -0.6, 0.6, 0.8).finished();
  for (Vec2& x : model.particles.position) x = turn * x;
  const Resultant load = load_on(model);  // on a face of 10 m from (0, 0) to (-6, 8)
  const double force = 9810 * (12 - 4) * 10;
  CHECK(load.force.x() == Approx(0.8 * force).epsilon(1e-6));
  CHECK(load.force.y() == Approx(0.6 * force).epsilon(1e-6));
}
