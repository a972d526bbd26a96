#include "solver/sph/consistent/flowing_soil.hpp"

#include <algorithm>
#include <cmath>

#include "solver/space/parallel.hpp"
#include "solver/sph/correction/kernel_correction.hpp"
#include "solver/sph/kernels/pair_weights.hpp"

namespace porosph {
namespace {

bool is_fixed_image(const ReferenceConfiguration& r, std::int32_t b) {
  const std::size_t n = r.particles();
  return static_cast<std::size_t>(b) >= n && r.ghosts.wall(b - n).support().carries_shear();
}

/// The part of a particle's move that does not bring it too near to a wall.
Vec2 short_of_walls(const Model& model, const Vec2& from, Vec2 move) {
  const double nearest = LooseParticles::nearest * model.spacing;
  for (const Wall& wall : model.walls) {
    const double towards = -move.dot(wall.normal);
    if (towards <= 0 || !wall.faces(from, model.spacing)) continue;
    const double room = std::max(0.0, wall.distance(from) - nearest);
    if (towards > room) move += (towards - room) * wall.normal;
  }
  return move;
}

/// L of eq. (10) by the soil alone.
Mat2 correction_by_soil(const ReferenceConfiguration& r, std::int32_t a) {
  const auto n = static_cast<std::int32_t>(r.particles());
  Mat2 sum = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    if (b < n) sum += Vec2(g.x, g.y) * (r.points[b] - r.points[a]).transpose();
  });
  return correction_matrix(sum);
}

}  // namespace

FlowingSoil::FlowingSoil(const Model& model, double control_viscosity) {
  if (std::ranges::none_of(model.soils, &Soil::flows)) return;
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
  const auto n = static_cast<std::int32_t>(r.particles());
  viscosity_.resize(r.points.size());
  at_walls_.clear();
  blind_.assign(n, 0);
  correction_.resize(n);
  std::vector<std::uint8_t> is_at_wall(n), has_ghosts(n);
  std::vector<std::int32_t> neighbours(n);  // of the soil
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) {
      if (b >= n)
        has_ghosts[a] = 1, is_at_wall[a] |= is_fixed_image(r, b);
      else
        ++neighbours[a];
    });
    correction_[a] = has_ghosts[a] ? correction_by_soil(r, a) : r.correction[a];
  }
  loose_.take(model, neighbours, has_ghosts, has_flowed_);
  for (std::int32_t a = 0; a < n; ++a)
    blind_[a] = is_at_wall[a] && (neighbours[a] >= LooseParticles::fewest_neighbours || loose_.is(a));
  wall_work_.take(r);
  diffusion_.take(r, model, loose_, correction_);
  deforms_.assign(n, 1);
  for (std::int32_t a = 0; a < n; ++a)
    if (loose_.is(a) || (has_flowed_ && is_at_wall[a])) deforms_[a] = 0;
  for (std::int32_t a = 0; a < n; ++a)
    if (is_at_wall[a] && model.soils[model.particles.soil[a]].flows()) at_walls_.push_back(a);
}

FlowingSoil::Gradients FlowingSoil::gradients(const ReferenceConfiguration& r, std::span<const Vec2> v,
                                              std::int32_t a) const {
  const auto n = static_cast<std::int32_t>(r.particles());
  Mat2 soil = Mat2::Zero(), walls = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    const Eigen::RowVector2d way(g.x, g.y);
    if (b < n)
      soil += (v[b] - v[a]) * way;
    else
      walls += (r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(v[r.ghosts.root(b - n)])) - v[a]) * way;
  });
  return {soil * correction_[a].transpose(), (soil + walls) * r.correction[a].transpose()};
}

void FlowingSoil::take_velocities(const ReferenceConfiguration& r, const Particles& p) {
  gradient_.resize(at_walls_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < at_walls_.size(); ++k) gradient_[k] = gradients(r, p.velocity, at_walls_[k]);
}

std::vector<std::pair<std::int32_t, Mat2>> FlowingSoil::rates_at_walls(const ReferenceConfiguration& r,
                                                                       std::span<const Vec2> v) const {
  std::vector<std::pair<std::int32_t, Mat2>> rates;
  if (!has_flowed_) return rates;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(r.particles()); ++a)
    if (loose_.is(a)) rates.emplace_back(a, Mat2::Zero());
  for (const std::int32_t a : at_walls_)
    if (!loose_.is(a)) rates.emplace_back(a, gradients(r, v, a).own);
  return rates;
}

double FlowingSoil::deform_at_walls(double dt, PlaneTensors& deformation) const {
  double largest = 0;
  if (!has_flowed_) return largest;
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::size_t k = 0; k < at_walls_.size(); ++k) {
    const std::int32_t a = at_walls_[k];
    if (loose_.is(a)) continue;
    const Mat2 f = deformation[a] + dt * gradient_[k].own;
    deformation.set(a, f);
    largest = std::max(largest, (f - Mat2::Identity()).cwiseAbs().maxCoeff());
  }
  return largest;
}

void FlowingSoil::leave_out_walls(const ReferenceConfiguration& r, PlaneTensors& flux,
                                  std::span<Record> records) const {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < at_walls_.size(); ++k) {
    const std::int32_t a = at_walls_[k];
    if (!blind_[a]) continue;
    flux.set(a, flux[a] + viscosity_[a] * (gradient_[k].with_walls - gradient_[k].own));
    if (!r.listed[a]) continue;
    for (int i = 0; i < 4; ++i) records[a].q[i] = flux.component[i][a];
  }
}

void FlowingSoil::leave_out_walls(const ReferenceConfiguration& r, const Particles& p,
                                  std::span<Vec2> accelerations) const {
  const auto n = static_cast<std::int32_t>(r.particles());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < at_walls_.size(); ++k) {
    const std::int32_t a = at_walls_[k];
    // The kernels have summed this particle's half of each pair; the image's own half is left out there.
    const Mat2& gradient = blind_[a] ? gradient_[k].own : gradient_[k].with_walls;
    Vec2 half = Vec2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (b < n || !is_fixed_image(r, b)) return;
      const Vec2 v = r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(p.velocity[r.ghosts.root(b - n)]));
      half += g.w * (v - p.velocity[a]) - gradient * Vec2(g.x, g.y);
    });
    accelerations[a] += (blind_[a] ? -1 : 1) * viscosity_[a] / (p.fill[a] * r.density[a]) * half;
  }
}

/// The control's part of what the kernels and leave_out_walls() sum.
void FlowingSoil::sample_work(const ReferenceConfiguration& r, const Particles& p,
                              const PlaneTensors& piola) {
  wall_work_.sample(r, p, piola);
  sample_.acceleration.clear();
  if (!sample_.due()) return;
  const auto n = static_cast<std::int32_t>(r.particles());
  std::vector<Mat2> gradient(n);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    const auto [own, with_walls] = gradients(r, p.velocity, a);
    gradient[a] = blind_[a] ? own : with_walls;
  }
  sample_.begin(p);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    Vec2 force = Vec2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      const Vec2 way(g.x, g.y);
      if (b < n) {
        force += (viscosity_[a] + viscosity_[b]) * g.w * (p.velocity[b] - p.velocity[a]) -
                 (viscosity_[a] * gradient[a] + viscosity_[b] * gradient[b]) * way;
        return;
      }
      const std::int32_t root = r.ghosts.root(b - n);
      const Vec2 v = r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(p.velocity[root]));
      if (!is_fixed_image(r, b))
        force +=
            (viscosity_[a] + viscosity_[b]) * g.w * (v - p.velocity[a]) -
            (viscosity_[a] * gradient[a] + viscosity_[b] * r.ghosts.flux_from_root(b - n, gradient[root])) *
                way;
      else if (!blind_[a])
        force += 2 * viscosity_[a] * (g.w * (v - p.velocity[a]) - gradient[a] * way);
    });
    sample_.acceleration[a] = force / (p.fill[a] * r.density[a]);
  }
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
