#include "solver/sph/wall_stop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace porosph {
namespace {

/// What a wall bears along itself: cohesion [Pa], and friction as the sine at which flowing soil slides.
struct Hold {
  double cohesion = 0, friction = 0;
};

Hold hold_of(const Wall& wall, const Soil& soil, const Particles& p, std::size_t a) {
  if (wall.kind == BoundaryKind::roller) return {};
  const Hold own{soil.cohesion(p, a), soil.sin_friction(p, a)};
  return wall.kind == BoundaryKind::friction ? Hold{0, std::min(wall.friction, own.friction)} : own;
}

/// The velocity that a wall leaves to a particle: none towards it, and along it less by what it bears over a
/// step, as `cohesion` [m/s] and as `friction` of what it has stopped.
Vec2 stopped(const Vec2& velocity, const Vec2& normal, double cohesion, double friction) {
  const double towards = -velocity.dot(normal);
  const Vec2 along = velocity + towards * normal;
  const double speed = along.norm(), lost = cohesion + friction * towards;
  return speed > lost ? Vec2((1 - lost / speed) * along) : Vec2(Vec2::Zero());
}

}  // namespace

Vec2 WallStop::velocity_after(const Model& model, const Watched& watched, Vec2 velocity) const {
  const Particles& p = model.particles;
  const std::size_t a = watched.particle;
  const double dx = model.spacing;
  for (const Wall& wall : model.walls) {
    const double towards = -velocity.dot(wall.normal);
    // A particle that is in the wall already, by less than a spacing, goes no further.
    const double range = dx + watched.nearest + towards * step_;
    if (towards <= 0 || wall.is_periodic() || !wall.faces(p.position[a] + dx * wall.normal, range)) continue;
    const Hold hold = hold_of(wall, model.soils[p.soil[a]], p, a);
    velocity = stopped(velocity, wall.normal, hold.cohesion * dx * step_ / p.mass[a], hold.friction);
  }
  return velocity;
}

void WallStop::apply(const Model& model, std::span<Vec2> accelerations) {
  taken_next_ = 0;
  if (step_ == 0) return;
  const Particles& p = model.particles;
  for (const Watched& watched : watched_) {
    const std::int32_t a = watched.particle;
    const Vec2 free = p.velocity[a] + step_ * accelerations[a];
    const Vec2 velocity = velocity_after(model, watched, free);
    if (velocity == free) continue;
    accelerations[a] = (velocity - p.velocity[a]) / step_;
    taken_next_ += 0.5 * p.mass[a] * (free - velocity).dot(p.velocity[a] + velocity);
  }
}

void WallStop::stepped(double dt) {
  work_ += std::exchange(taken_next_, 0);
  step_ = dt;
}

void WallStop::visit(StateArchive& state) {
  state.value("stopped_step", step_);
  state.value("stopped_work", work_);
}

}  // namespace porosph
