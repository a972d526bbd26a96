#include "solver/sph/consistent/wall_work.hpp"

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

constexpr int steps_between_samples = 4;  // landings of a particle last no longer than some steps

}  // namespace

void WallWork::take(std::span<const std::uint8_t> see_ghosts) {
  at_walls_.clear(), force_.clear(), flux_.clear();
  for (std::size_t a = 0; a < see_ghosts.size(); ++a)
    if (see_ghosts[a]) at_walls_.push_back(static_cast<std::int32_t>(a));
}

void WallWork::sample(const ReferenceConfiguration& r, const Particles& p, const PlaneTensors& piola) {
  velocity_.clear();
  if (steps_ % steps_between_samples != 0) return;
  velocity_ = p.velocity;
  const auto n = static_cast<std::int32_t>(r.particles());
  force_.resize(at_walls_.size()), flux_.resize(at_walls_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < at_walls_.size(); ++k) {
    const std::int32_t a = at_walls_[k];
    const auto flux = [&](std::int32_t b, std::int32_t root) {
      return Mat2(p.fill[root] * piola[b] * r.correction[b]);
    };
    flux_[k] = flux(a, a);
    Vec2 force = Vec2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (b >= n) force += flux(b, r.ghosts.root(b - n)) * Vec2(g.x, g.y);
    });
    force_[k] = force;
  }
}

void WallWork::count(const ReferenceConfiguration& r, const Particles& p, double dt) {
  ++steps_;
  if (velocity_.empty() || force_.size() != at_walls_.size()) return;
  const auto n = static_cast<std::int32_t>(r.particles());
  const auto velocity = [&](std::int32_t a) { return Vec2(0.5 * (velocity_[a] + p.velocity[a])); };
  work_ -= steps_between_samples * dt * deterministic_sum(at_walls_.size(), [&](std::size_t k) {
             const std::int32_t a = at_walls_[k];
             double power = force_[k].dot(velocity(a));
             r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
               if (b < n) return;
               const Vec2 v = r.ghosts.from_root<Mirrors::motion>(b - n, velocity(r.ghosts.root(b - n)));
               power += v.dot(flux_[k] * Vec2(g.x, g.y));
             });
             return r.volume[a] * power;
           });
}

void WallWork::visit(StateArchive& state) {
  state.value("wall_work", work_), state.value("wall_work_steps", steps_);
}

}  // namespace porosph
