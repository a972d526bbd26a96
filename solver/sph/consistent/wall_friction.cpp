#include "solver/sph/consistent/wall_friction.hpp"

#include <algorithm>
#include <cmath>

namespace porosph {
namespace {

/// Steady sliding of an elastic body against Coulomb's friction is unstable, whatever its discretisation
/// (Adams 1995): vibrations across the wall and along it feed each other. Friction that follows the pressure
/// with a delay, as measured by Prakash and Clifton (1993), is not. In times that a wave takes through h.
constexpr double lag = 20;

Vec2 direction(const Wall& wall) { return (wall.to - wall.from).normalized(); }

/// What makes of a ghost's stress that behind a wall with friction, so that the mean traction along the wall
/// is `shear` and nothing else acts along it, nor friction across it, at the ends of a body either: there a
/// stress along the wall that differs from the particle's own would push, and a shear stress that changes
/// sign would press the body on the wall. `own`: of what the ghost mirrors.
Mat2 added_by_friction(const Mat2& ghost, const Mat2& own, double shear, const Wall& wall) {
  const Vec2 n = wall.normal, t = direction(wall);
  return 2 * shear * t * n.transpose() - 2 * n.dot(ghost * t) * n * t.transpose() +
         t.dot((own - ghost) * t) * t * t.transpose();
}

}  // namespace

double friction_memory(const Model& model) { return lag * model.smoothing_length / model.wave_speed; }

WallFriction::WallFriction(const Model& model)
    : spacing_(model.spacing), smoothing_length_(model.smoothing_length), memory_(friction_memory(model)) {
  const std::vector<double> zero(model.particles.size(), 0);
  for (std::size_t w = 0; w < model.walls.size(); ++w)
    if (model.walls[w].kind == BoundaryKind::friction)
      walls_.push_back({static_cast<std::int32_t>(w), zero, zero, zero, {}, {}, {}});
}

void WallFriction::take(const ReferenceConfiguration& r, const Model& model) {
  constexpr double row = 0.8;  // of the spacing: the particles next to the wall
  for (AtWall& at : walls_) {
    const Wall& wall = model.walls[at.wall];
    at.near.clear(), at.row.clear(), at.ghosts.clear();
    std::vector<std::uint8_t> is_near(r.particles(), 0), is_next(r.particles(), 0);
    for (std::size_t i = 0; i < r.ghosts.size(); ++i) {
      if (r.ghosts.image(i).wall != at.wall) continue;
      at.ghosts.push_back(i);
      const std::int32_t a = r.ghosts.root(i);
      if (r.ghosts.stems_from_ghost(i) || is_near[a]) continue;
      is_near[a] = 1, at.near.push_back(a);
      if (wall.distance(r.points[a]) > row * spacing_) continue;
      is_next[a] = 1, at.row.push_back(a);
    }
    std::ranges::sort(at.row, {}, [&](std::int32_t a) {
      return std::pair((r.points[a] - wall.from).dot(direction(wall)), a);
    });
    for (std::size_t a = 0; a < r.particles(); ++a) {  // those that have left the wall
      if (!is_next[a]) at.shear[a] = 0;
      if (!is_near[a]) at.pressure[a] = at.lagging[a] = 0;
    }
  }
}

void WallFriction::slide(const Model& model, double dt) {
  const Particles& p = model.particles;
  for (AtWall& at : walls_) {
    const Wall& wall = model.walls[at.wall];
    const Vec2 t = direction(wall);
    for (const std::int32_t a : at.near)
      at.lagging[a] += (std::max(0.0, at.pressure[a]) - at.lagging[a]) * std::min(1.0, dt / memory_);
    for (const std::int32_t a : at.row) {
      const double stiffness = model.soils[p.soil[a]].shear_modulus() / smoothing_length_;
      const double most = wall.friction * at.lagging[a];
      at.shear[a] = std::clamp(at.shear[a] + stiffness * p.velocity[a].dot(t) * dt, -most, most);
    }
  }
}

/// Share of the friction that the row's springs need around the particle's foot on the wall, -1 to 1.
double WallFriction::mobilised_beside(const AtWall& at, const ReferenceConfiguration& r, const Wall& wall,
                                      std::int32_t particle) const {
  const Vec2 t = direction(wall);
  const auto along = [&](std::int32_t a) { return (r.points[a] - wall.from).dot(t); };
  const double foot = along(particle), reach = spacing_ * (1 + 1e-9);
  double sum = 0, most = 0;
  auto first = std::ranges::lower_bound(at.row, foot - reach, {}, along);
  for (; first != at.row.end() && along(*first) <= foot + reach; ++first) {
    const double weight = 1.01 - std::abs(along(*first) - foot) / reach;
    sum += weight * at.shear[*first], most += weight * wall.friction * at.lagging[*first];
  }
  return most > 0 ? sum / most : 0;
}

void WallFriction::apply(const ReferenceConfiguration& r, PlaneTensors& piola) {
  const std::size_t n = r.particles();
  std::vector<std::uint8_t> changed(r.ghosts.size(), 0);
  added_.assign(r.ghosts.size(), PlaneTensor{});
  for (AtWall& at : walls_) {
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < at.ghosts.size(); ++k) {
      const std::size_t i = at.ghosts[k];
      const Wall& wall = r.ghosts.wall(i);
      const std::int32_t a = r.ghosts.root(i);
      const Mat2 ghost = piola[n + i];
      if (!r.ghosts.stems_from_ghost(i))
        at.pressure[a] = -0.5 * wall.normal.dot((ghost + piola[a]) * wall.normal);
      const double shear = mobilised_beside(at, r, wall, a) * wall.friction * at.lagging[a];
      const Mat2 own = piola[r.ghosts.parent(i)];
      added_[i] = plane_tensor(added_by_friction(ghost, own, shear, wall));
      piola.set(n + i, ghost + matrix(added_[i]));
      changed[i] = 1;
    }
  }
  for (const std::size_t i : r.ghosts.of_ghosts()) {  // what other walls mirror of it
    if (changed[i] || !changed[r.ghosts.parent(i) - n]) continue;
    const std::size_t parent = r.ghosts.parent(i);
    piola.set(n + i, r.ghosts.mirrored<Mirrors::tensor>(i, piola[parent]));
    added_[i] = plane_tensor(r.ghosts.mirrored<Mirrors::tensor>(i, matrix(added_[parent - n])));
    changed[i] = 1;
  }
}

void WallFriction::sample(const ReferenceConfiguration& r, const Particles& p) {
  sample_.acceleration.clear();
  if (!sample_.due()) return;
  const auto n = static_cast<std::int32_t>(p.size());
  sample_.begin(p);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    Vec2 force = Vec2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (b < n) return;
      const double fill = p.fill[r.ghosts.root(b - n)];
      force += fill * matrix(added_[b - n]) * r.correction[b] * Vec2(g.x, g.y);
    });
    sample_.acceleration[a] = force / (p.fill[a] * r.density[a]);
  }
}

void WallFriction::count(const Particles& p, double dt) { work_ += sample_.taken(p, dt); }

void WallFriction::visit(StateArchive& state) {
  for (AtWall& at : walls_) {
    state.array("wall_shear", at.shear);
    state.array("wall_pressure", at.pressure);
    state.array("wall_pressure_lagging", at.lagging);
  }
  if (!active()) return;
  state.value("wall_friction_samples", sample_.steps);
  state.value("wall_friction_work", work_);
}

}  // namespace porosph
