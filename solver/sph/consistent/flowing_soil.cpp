#include "solver/sph/consistent/flowing_soil.hpp"

#include <algorithm>
#include <cmath>

#include "solver/space/freed_memory.hpp"
#include "solver/space/parallel.hpp"
#include "solver/sph/consistent/control_forces.hpp"
#include "solver/sph/kernels/pair_weights.hpp"

namespace porosph {
namespace {

/// The part of a particle's move that does not bring it too near to a wall.
Vec2 short_of_walls(const Model& model, const Vec2& from, Vec2 move) {
  const double nearest = LooseParticles::nearest * model.spacing;
  for (const Wall& wall : model.walls) {
    const double towards = -move.dot(wall.normal);
    if (towards <= 0 || wall.is_periodic() || !wall.faces(from, model.spacing)) continue;
    const double room = std::max(0.0, wall.distance(from) - nearest);
    if (towards > room) move += (towards - room) * wall.normal;
  }
  return move;
}

}  // namespace

FlowingSoil::FlowingSoil(const Model& model, double control_viscosity) {
  if (std::ranges::none_of(model.soils, &Soil::flows)) return;
  keep_freed_memory();
  const Particles& p = model.particles;
  rest_density_.resize(p.size());
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Soil& soil = model.soils[p.soil[a]];
    rest_density_[a] =
        p.density[a] * std::exp(p.stress[a].mean() / soil.bulk_modulus() + soil.plastic_dilation(p, a));
  }
  viscosity_.assign(p.size(), control_viscosity);
  diffusion_ = StressDiffusion(p.size());
  work_.beyond_linear_at_start = energy_beyond_linear(model);
}

double energy_beyond_linear(const Model& model) {
  if (std::ranges::none_of(model.soils, &Soil::stiffness_varies)) return 0;
  const Particles& p = model.particles;
  return deterministic_sum(p.size(), [&](std::size_t a) {
    const Soil& soil = model.soils[p.soil[a]];
    const CamClay* clay = std::get_if<CamClay>(&soil.law());
    if (clay == nullptr) return 0.0;
    return p.volume(a) * (clay->swelling_energy(p.stress[a]) - soil.stored_energy(p.stress[a]));
  });
}

void FlowingSoil::settle(Model& model, const ReferenceConfiguration& reference) {
  has_flowed_ = has_flowed_ || diffusion_.has_sheared();
  even_out(model, reference);
  diffusion_.forget_shear();
  update_density(model);
}

/// Elastic volume strain and dilation, without what has opened.
void FlowingSoil::update_density(Model& model) const {
  Particles& p = model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Soil& soil = model.soils[p.soil[a]];
    if (!soil.flows()) continue;
    p.density[a] =
        rest_density_[a] * std::exp(-p.stress[a].mean() / soil.bulk_modulus() - soil.plastic_dilation(p, a));
  }
}

namespace {

/// Where a particle is to move, by where its neighbours are.
struct Crowd {
  Vec2 gradient = Vec2::Zero();  ///< of sum V W [1/m]
  Vec2 apart = Vec2::Zero();     ///< from those that are too near [m]
  bool is_inside = false;        ///< the soil, not near its surface
};

Crowd crowd_around(std::int32_t a, std::span<const std::int32_t> neighbours, std::span<const Vec2> points,
                   const WeighedPoints<2>& weighed, double nearest) {
  constexpr double inside = 0.95, share = 0.1;
  const std::span<const double> weights = weights_of(a, neighbours, weighed);
  Crowd crowd;
  Mat2 sum = Mat2::Zero();
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec2 way = points[neighbours[k]] - points[a], g = weights[k] * way;
    crowd.gradient += g, sum += g * way.transpose();
    const double squared = way.squaredNorm();
    if (squared > 0 && squared < nearest * nearest)
      crowd.apart -= share * (nearest / std::sqrt(squared) - 1) * way;
  }
  const double half = 0.5 * (sum(0, 0) - sum(1, 1));
  const double least = 0.5 * (sum(0, 0) + sum(1, 1)) - std::sqrt(half * half + sum(0, 1) * sum(0, 1));
  crowd.is_inside = least > inside;
  return crowd;
}

}  // namespace

/// Soil that has flowed since the last reference: inside it down the gradient of sum V W (Lind et al. 2012),
/// not near its surface; and pairs that are nearer than half of the spacing apart, also from their images.
/// Elastic strain leaves particles where they are in the soil. Neighbours are those of the reference that
/// ends: what is near to become one, at the rim of the kernel, hardly counts.
void FlowingSoil::even_out(Model& model, const ReferenceConfiguration& r) {
  constexpr double strength = 0.5;
  Particles& p = model.particles;
  const std::size_t n = p.size();
  std::vector<Vec2> moves(n, Vec2::Zero()), points = p.position;
  r.ghosts.fill_positions(points);
  std::vector<double> volumes(n);
  for (std::size_t a = 0; a < n; ++a) volumes[a] = p.volume(a) / p.fill[a];
  r.ghosts.fill<Mirrors::scalar>(volumes);
  const WeighedPoints<2> weighed{points.data()->data(), volumes.data(),
                                 CubicSpline<2>(model.smoothing_length)};
  const double farthest = 0.1 * model.spacing, h2 = model.smoothing_length * model.smoothing_length;
#pragma omp parallel
  {
    std::vector<std::int32_t> room;
#pragma omp for schedule(static)
    for (std::size_t a = 0; a < n; ++a) {
      const bool has_flowed = diffusion_.has_sheared(a) || loose_.is(a);
      if (!has_flowed || !model.soils[p.soil[a]].flows()) continue;
      const auto number = static_cast<std::int32_t>(a);
      const Crowd crowd =
          crowd_around(number, r.stencils.neighbours(number, room), points, weighed, 0.5 * model.spacing);
      moves[a] = crowd.apart;
      if (!crowd.is_inside) continue;
      const Vec2 move = -strength * h2 * crowd.gradient;
      const double far = move.norm();
      moves[a] += far > farthest ? Vec2(move * (farthest / far)) : move;
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    const Vec2 move = short_of_walls(model, p.position[a], moves[a]);
    p.position[a] += move;
    work_.shift -= p.mass[a] * model.gravity.dot(move);
  }
}

void FlowingSoil::take(const ReferenceConfiguration& r, const Model& model) {
  viscosity_.resize(r.points.size());
  rows_.find(r, model);
  loose_.take(model, rows_.neighbours(), rows_.see_ghosts(), has_flowed_);
  rows_.blind(loose_);
  wall_work_.take(rows_.see_ghosts());
  diffusion_.take(r, model, loose_, rows_.correction());
  deforms_.assign(r.particles(), 1);
  for (std::size_t a = 0; a < r.particles(); ++a)
    if (loose_.is(a) || (has_flowed_ && rows_.see_fixed(a))) deforms_[a] = 0;
}

void FlowingSoil::sample_work(const ReferenceConfiguration& r, const Particles& p,
                              const PlaneTensors& piola) {
  wall_work_.sample(r, p, piola);
  sample_.acceleration.clear();
  if (!sample_.due()) return;
  sample_.begin(p);
  control_forces(r, p, rows_, viscosity_, sample_.acceleration);
}

void FlowingSoil::count_work(const ReferenceConfiguration& r, const Particles& p, double dt) {
  wall_work_.count(r, p, dt);
  work_.control += sample_.taken(p, dt);
}

void FlowingSoil::visit(StateArchive& state) {
  if (!active()) return;
  state.array("rest_density", rest_density_);
  state.array("control_viscosity", std::span(viscosity_).first(rest_density_.size()));
  diffusion_.visit(state);
  state.value("has_flowed", has_flowed_);
  state.value("control_samples", sample_.steps);
  loose_.walls().visit(state);
  wall_work_.visit(state);
  for (double* work : {&work_.plastic, &work_.viscous, &work_.control, &work_.diffusion, &work_.shift,
                       &work_.beyond_linear_at_start})
    state.value("work", *work);
}

}  // namespace porosph
