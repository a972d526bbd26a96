// Who sees whom past outlines and through walls.
#include "solver/boundary/visibility.hpp"

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"
#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/step_by_hand.hpp"

using namespace porosph;

namespace {

/// The particle that started nearest to a place.
std::int32_t at(const Model& model, double x, double y) {
  const auto& start = model.particles.start;
  const auto nearest = std::min_element(start.begin(), start.end(), [&](const Vec2& a, const Vec2& b) {
    return (a - Vec2(x, y)).norm() < (b - Vec2(x, y)).norm();
  });
  return static_cast<std::int32_t>(nearest - start.begin());
}

bool sees(const Model& model, const Vec2& a, const Vec2& b) {
  return model.visibility.sees(at(model, a.x(), a.y()), at(model, b.x(), b.y()), model.particles);
}

Case with_outline(const Polygon& outline, double spacing = 0.5) {
  Case scene = box_of_soil(20, 16, spacing);
  scene.soils[0].polygon = outline;
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

/// Rock of 4 m under the right half of ground of 8 m, all of it fixed.
Case rock_step(double spacing) {
  Case scene = with_outline({{0, 0}, {10, 0}, {10, 4}, {20, 4}, {20, 8}, {0, 8}}, spacing);
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {10, 0});
  add_wall(scene, BoundaryKind::fixed, {10, 0}, {10, 4});
  add_wall(scene, BoundaryKind::fixed, {10, 4}, {20, 4});
  return scene;
}

}  // namespace

TEST_CASE("a box between walls hides nothing", "[visibility]") {
  Case scene = box_of_soil(10, 8);
  hold_as_column(scene);
  CHECK(build_model(scene).visibility.everywhere());
}

TEST_CASE("a slit and a gap part the soil, its tip and a toe do not", "[visibility]") {
  const Model slot =
      build_model(with_outline({{0, 0}, {10, 0}, {10, 8}, {5.2, 8}, {5.2, 4}, {5, 4}, {5, 8}, {0, 8}}));
  CHECK_FALSE(slot.visibility.everywhere());
  CHECK_FALSE(sees(slot, {4.75, 6.25}, {5.4, 6.25}));
  CHECK(sees(slot, {4.75, 3.25}, {5.4, 3.25}));
  CHECK(sees(slot, {4.75, 6.25}, {4.25, 6.75}));

  const Model toe = build_model(with_outline({{0, 0}, {10, 0}, {10, 7}, {7, 4}, {0, 4}}));
  CHECK(toe.visibility.everywhere());
}

TEST_CASE("bodies that a gap parts see each other once they touch", "[visibility]") {
  Case scene = with_outline(box_outline(0, 0, 2, 2));
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "other", scene.soils[1].polygon = box_outline(2.4, 0, 4.4, 2);
  Model model = build_model(scene);
  const std::int32_t a = at(model, 1.75, 0.75), b = at(model, 2.65, 0.75);
  CHECK_FALSE(model.visibility.sees(a, b, model.particles));
  model.particles.position[b].x() -= 0.6;
  CHECK(model.visibility.sees(a, b, model.particles));
}

TEST_CASE("linear velocities have exact gradients between corners of walls of any angle", "[visibility]") {
  const double spacing = 0.5;
  std::vector<Case> scenes = {rock_step(spacing)};
  Case inclined = with_outline({{0, 0}, {10, 1.5}, {10, 6.5}, {0, 5}}, spacing);
  add_wall(inclined, BoundaryKind::roller, {0, 0}, {10, 1.5});
  add_wall(inclined, BoundaryKind::roller, {0, 0}, {0, 5});
  add_wall(inclined, BoundaryKind::roller, {10, 1.5}, {10, 6.5});
  scenes.push_back(inclined);
  for (Case& scene : scenes) {
    scene.particles.arrangement = Arrangement::fitted;
    scene.loading.gravity_applied = false;
    Model model = build_model(scene);
    CHECK_FALSE(model.visibility.everywhere());
    const auto dynamics = make_dynamics(scene.formulation, model);
    // Nothing that moves as a whole along free directions strains: at rest all gradients are zero.
    for (const Mat2& g : velocity_gradients_of(*dynamics, model)) CHECK(g.norm() == 0);
    // A velocity that the walls allow, away from them linear: seen exactly where no ghost is near.
    const Mat2 gradient = (Mat2() << 1e-3, 2e-3, -1e-3, 3e-3).finished();
    for (std::size_t i = 0; i < model.particles.size(); ++i)
      model.particles.velocity[i] = gradient * model.particles.position[i];
    const std::vector<Mat2> found = velocity_gradients_of(*dynamics, model);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Vec2& x = model.particles.position[i];
      const bool near_wall = std::any_of(model.walls.begin(), model.walls.end(), [&](const Wall& w) {
        return std::abs(w.distance(x)) < 3 * model.smoothing_length;
      });
      if (!near_wall) CHECK((found[i] - gradient).norm() < 1e-12);
    }
  }
}
