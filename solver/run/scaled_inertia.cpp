#include "solver/run/scaled_inertia.hpp"

#include <algorithm>
#include <set>

#include "solver/case/inertia.hpp"
#include "solver/space/parallel.hpp"
#include "solver/sph/neighbours/neighbour_list.hpp"

namespace porosph {

/// Bodies of stiff soil. Whatever may be held together by a stiff soil's stress counts as one body, and
/// whatever may be held by a wall as held: a body that is held too little would be too fast for the time
/// step.
class ScaledInertia::Finder {
 public:
  Finder(const Model& model, ScaledInertia& out)
      : model_(model),
        out_(out),
        reach_(2 * model.smoothing_length),
        near_(find_neighbours(out.place_, out.place_.size(), reach_)) {}

  void find() {
    const std::set<double, std::greater<>> levels(out_.inertia_.begin(), out_.inertia_.end());
    for (const double level : levels)
      if (level > 1) find_bodies(level);
  }

 private:
  void find_bodies(double level) {
    std::vector<char> seen(out_.place_.size());
    for (std::size_t a = 0; a < seen.size(); ++a) {
      if (seen[a] || out_.inertia_[a] != level) continue;
      Body body = grow(static_cast<std::int32_t>(a), level, seen);
      weigh(body);
      hold(body);
      if (body.moment > 0 || !body.free.isZero()) out_.bodies_.push_back(std::move(body));
    }
  }

  /// All that hangs together with a particle of the soil that the body is named by.
  Body grow(std::int32_t seed, double level, std::vector<char>& seen) const {
    Body body;
    body.own = level;
    body.particles.push_back(seed), seen[seed] = 1;
    for (std::size_t k = 0; k < body.particles.size(); ++k)
      for (const std::int32_t b : near_.of(body.particles[k])) {
        const double s = out_.inertia_[b];
        if (s < level)
          body.around = std::max(body.around, s);
        else if (!seen[b])
          body.particles.push_back(b), seen[b] = 1;
      }
    std::ranges::sort(body.particles);
    return body;
  }

  void weigh(Body& body) const {
    for (const std::int32_t a : body.particles)
      body.mass += out_.mass_[a], body.centre += out_.mass_[a] * out_.place_[a];
    body.centre /= body.mass;
    for (const std::int32_t a : body.particles)
      body.moment += out_.mass_[a] * out_.arm(body, a).squaredNorm();
  }

  /// Along a roller it may slide; a body of one particle does not turn.
  void hold(Body& body) const {
    for (const Wall& wall : model_.walls) {
      const bool holds = std::ranges::any_of(
          body.particles, [&](std::int32_t a) { return wall.faces(out_.place_[a], reach_, reach_); });
      if (!holds) continue;
      body.moment = 0;
      const Vec2 along(-wall.normal.y(), wall.normal.x());
      const bool slides = wall.kind == BoundaryKind::roller && (body.free * along - along).norm() < 1e-9;
      body.free = slides ? Mat2(along * along.transpose()) : Mat2(Mat2::Zero());
    }
  }

  const Model& model_;
  ScaledInertia& out_;
  double reach_;  ///< of particles to each other, and at most to walls [m]
  NeighbourList near_;
};

ScaledInertia::ScaledInertia(const Case& scene, const Model& model) {
  const std::vector<double> of_soil = inertia_over_mass(scene);
  if (std::ranges::all_of(of_soil, [](double s) { return s == 1; })) return;
  mass_ = model.particles.mass, place_ = model.particles.start;
  for (const std::int32_t soil : model.particles.soil) inertia_.push_back(of_soil[soil]);
  before_.assign(mass_.size(), Vec2::Zero());
  Finder(model, *this).find();
}

Vec2 ScaledInertia::arm(const Body& body, std::int32_t a) const {
  const Vec2 from = place_[a] - body.centre;
  return {-from.y(), from.x()};
}

ScaledInertia::Rigid ScaledInertia::nearest(const Body& body, std::span<const Vec2> field) const {
  struct Sum {
    Vec2 momentum = Vec2::Zero();
    double spin = 0;
    Sum& operator+=(const Sum& o) {
      momentum += o.momentum, spin += o.spin;
      return *this;
    }
  };
  const Sum all = deterministic_sum<Sum>(body.particles.size(), [&](std::size_t k) {
    const std::int32_t a = body.particles[k];
    return Sum{mass_[a] * field[a], mass_[a] * arm(body, a).dot(field[a])};
  });
  return {body.free * all.momentum / body.mass, body.moment > 0 ? all.spin / body.moment : 0};
}

void ScaledInertia::scale(std::span<Vec2> accelerations) const {
  std::vector<Rigid> rigid;
  for (const Body& body : bodies_) rigid.push_back(nearest(body, accelerations));
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < inertia_.size(); ++a) accelerations[a] /= inertia_[a];
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& body = bodies_[k];
    const double more = 1 / body.around - 1 / body.own;
    for (const std::int32_t a : body.particles)
      accelerations[a] += more * (rigid[k].centre + rigid[k].turn * arm(body, a));
  }
}

std::span<const Vec2> ScaledInertia::take_step(std::span<const Vec2> by_mass) {
  constexpr double damping = 0.1;  // c dt = 0.1 (omega dt)^2; docs/theory.md says what it does
  next_.resize(by_mass.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < by_mass.size(); ++a) {
    const Vec2 now = by_mass[a];
    next_[a] = inertia_[a] > 1 ? Vec2(now + damping * (now - before_[a])) : now;
    before_[a] = now;
  }
  scale(next_);
  return next_;
}

void ScaledInertia::visit(StateArchive& state) {
  if (acts()) state.array("accelerations_before", before_);
}

double ScaledInertia::kinetic_energy(std::span<const Vec2> velocities) const {
  double twice = deterministic_sum(
      mass_.size(), [&](std::size_t a) { return mass_[a] * inertia_[a] * velocities[a].squaredNorm(); });
  for (const Body& body : bodies_) {
    const Rigid rigid = nearest(body, velocities);
    twice -= (body.own - body.around) *
             (body.mass * rigid.centre.squaredNorm() + body.moment * rigid.turn * rigid.turn);
  }
  return 0.5 * twice;
}

}  // namespace porosph
