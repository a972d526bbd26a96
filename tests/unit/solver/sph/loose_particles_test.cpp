// Particles that have come off a body: who they are, and how walls stop and hold them.
#include "solver/sph/consistent/loose_particles.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr double spacing = 0.5, dt = 1e-3, g = 9.81, angle = 30, sine = 0.5;

/// Four particles on a wall, the lowest at half a spacing; the second is given seven neighbours, the others
/// two.
struct OnWall {
  explicit OnWall(BoundaryKind kind, double cohesion = 0) {
    Case scene = box_of_soil(1, 4, spacing);
    scene.soils[0].law = LawKind::mohr_coulomb;
    scene.soils[0].strength.friction_angle = angle;
    scene.soils[0].strength.cohesion = cohesion;
    add_wall(scene, kind, {-10, 0}, {10, 0});
    if (kind == BoundaryKind::friction) scene.boundaries.back().coefficient = 0.2;
    model = build_model(scene);
    neighbours = {2, 7, 2, 2};
    at_walls.assign(4, 1);
    loose.take(model, neighbours, at_walls, true);
    loose.walls().stepped(dt);
  }
  /// Velocity after a step under gravity of particle `a`, put to this height with this velocity.
  Vec2 after(std::size_t a, double height, Vec2 velocity) {
    model.particles.position[a].y() = height;
    model.particles.velocity[a] = velocity;
    std::vector<Vec2> accelerations(4, Vec2(0, -g));
    loose.walls().apply(model, accelerations);
    return velocity + dt * accelerations[a];
  }

  Model model;
  std::vector<std::int32_t> neighbours;
  std::vector<std::uint8_t> at_walls;
  LooseParticles loose;
};

}  // namespace

TEST_CASE("particles with few neighbours are loose where soil has flowed") {
  OnWall scene(BoundaryKind::fixed);
  CHECK(scene.loose.is(0));
  CHECK_FALSE(scene.loose.is(1));
  CHECK(scene.loose.bears()[0] == 0);
  CHECK(scene.loose.bears()[1] == 1);
  scene.loose.take(scene.model, scene.neighbours, scene.at_walls, false);
  CHECK_FALSE(scene.loose.is(0));
}

TEST_CASE("a row on a wall is of the body where the smoothing length is one spacing") {
  OnWall scene(BoundaryKind::fixed);
  scene.model.smoothing_length = scene.model.spacing;
  scene.neighbours = {4, 5, 5, 7};
  scene.loose.take(scene.model, scene.neighbours, scene.at_walls, true);
  CHECK(scene.loose.is(0));
  CHECK_FALSE(scene.loose.is(1));
}

TEST_CASE("a wall stops a loose particle without rebound and holds it by the soil's friction") {
  OnWall scene(BoundaryKind::fixed);
  const Vec2 slid =
      scene.after(0, 0.25, {1, 0});  // Mohr-Coulomb in plane flow slides at the sine of its angle
  CHECK(slid.y() == Approx(0).margin(1e-12));
  CHECK(slid.x() == Approx(1 - sine * g * dt));
  const Vec2 landed = scene.after(0, 0.2501, {2, -1});
  CHECK(landed.y() == Approx(0).margin(1e-12));
  CHECK(landed.x() == Approx(2 - sine * (1 + g * dt)));
  CHECK(scene.after(0, 0.25, {0.001, 0}).norm() ==
        Approx(0).margin(1e-12));                                     // friction stops, and does not push
  CHECK(scene.after(0, 0.25, {1, 0.5}).y() == Approx(0.5 - g * dt));  // it may leave
  CHECK(scene.after(0, 0.5, {1, -1}).y() == Approx(-1 - g * dt));     // it is not there yet
}

TEST_CASE("what walls take from loose particles is their work") {
  OnWall scene(BoundaryKind::fixed);
  const double mass = scene.model.particles.mass[0];
  CHECK(scene.loose.walls().work() == 0);
  const Vec2 landed = scene.after(0, 0.25, {2, -1});
  CHECK(scene.after(0, 0.25, {2, -1}) == landed);  // forces may be summed twice in a step
  CHECK(scene.loose.walls().work() == 0);
  scene.loose.walls().stepped(dt);
  const Vec2 free(2, -1 - g * dt), mean = 0.5 * (Vec2(2, -1) + landed);
  CHECK(scene.loose.walls().work() == Approx(mass * (free - landed).dot(mean)));
}

TEST_CASE("walls hold as much as they and the soil can") {
  CHECK(OnWall(BoundaryKind::roller).after(0, 0.25, {1, 0}).x() == Approx(1));
  CHECK(OnWall(BoundaryKind::friction).after(0, 0.25, {1, 0}).x() == Approx(1 - 0.2 * g * dt));
  OnWall clay(BoundaryKind::fixed, 10e3);
  const double held = 10e3 * std::cos(angle * M_PI / 180) * spacing * dt / clay.model.particles.mass[0];
  CHECK(clay.after(0, 0.25, {1, 0}).x() == Approx(1 - held - sine * g * dt));
}

TEST_CASE("walls stop the body's particles at a quarter of the spacing") {
  OnWall scene(BoundaryKind::fixed);
  CHECK(scene.after(1, 0.2, {0, -1}).y() == Approx(-1 - g * dt));
  CHECK(scene.after(1, 0.125, {0, -1}).y() == Approx(0).margin(1e-12));
  CHECK(scene.after(1, -0.05, {0, -1}).y() == Approx(0).margin(1e-12));  // nor does it sink further
}
