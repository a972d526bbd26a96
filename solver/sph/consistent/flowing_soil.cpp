#include "solver/sph/consistent/flowing_soil.hpp"

#include <algorithm>
#include <cmath>

#include "solver/space/parallel.hpp"
#include "solver/sph/correction/kernel_correction.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"

namespace porosph {
namespace {

using Vec4 = Eigen::Vector4d;
using Gradient4 = Eigen::Matrix<double, 4, 2>;

Vec4 vector(const Stress& s) { return {s.xx, s.yy, s.zz, s.xy}; }

bool is_fixed_image(const ReferenceConfiguration& r, std::int32_t b) {
  const std::size_t n = r.particles();
  return static_cast<std::size_t>(b) >= n && r.ghosts.wall(b - n).support().carries_shear();
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
  shear_rate_.assign(p.size(), 0);
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

void FlowingSoil::settle(Model& model, Surroundings& surroundings) {
  has_flowed_ = true;
  even_out(model, surroundings.find(model));
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

/// Inside the soil down the gradient of sum V W (Lind et al. 2012), not near its surface; and pairs that are
/// nearer than half of the spacing apart, also from their images.
void FlowingSoil::even_out(Model& model, const SeenNeighbours& seen) {
  constexpr double strength = 0.5, farthest = 0.02, inside = 0.95, share = 0.1;
  Particles& p = model.particles;
  const CubicSpline<2> kernel(model.smoothing_length);
  const std::size_t n = p.size();
  std::vector<Vec2> moves(n, Vec2::Zero());
  const double dx = model.spacing, nearest = 0.5 * dx, h2 = model.smoothing_length * model.smoothing_length;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    if (!model.soils[p.soil[a]].flows()) continue;
    Vec2 crowd = Vec2::Zero(), apart = Vec2::Zero();
    Mat2 sum = Mat2::Zero();
    for (const std::int32_t b : seen.list.of(a)) {
      const std::size_t root = static_cast<std::size_t>(b) < n ? b : seen.ghosts.root(b - n);
      const Vec2 way = seen.points[b] - seen.points[a];
      const double distance = way.norm(), volume = p.volume(root) / p.fill[root];
      const Vec2 g = -volume * kernel.slope(distance) * way;
      crowd += g, sum += g * way.transpose();
      if (distance > 0 && distance < nearest) apart -= share * (nearest / distance - 1) * way;
    }
    const double half = 0.5 * (sum(0, 0) - sum(1, 1));
    const double least = 0.5 * (sum(0, 0) + sum(1, 1)) - std::hypot(half, sum(0, 1));
    if (least > inside) {
      const Vec2 move = -strength * h2 * crowd;
      const double far = move.norm();
      apart += far > farthest * dx ? Vec2(move * (farthest * dx / far)) : move;
    }
    moves[a] = apart;
  }
  for (std::size_t a = 0; a < n; ++a) {
    p.position[a] += moves[a];
    work_.shift -= p.mass[a] * model.gravity.dot(moves[a]);
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
    Mat2 sum = Mat2::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (b >= n) {
        has_ghosts[a] = 1, is_at_wall[a] |= is_fixed_image(r, b);
      } else {
        ++neighbours[a], sum += Vec2(g.x, g.y) * (r.points[b] - r.points[a]).transpose();
      }
    });
    correction_[a] = has_ghosts[a] ? correction_matrix(sum) : r.correction[a];
  }
  loose_.take(model, neighbours, has_ghosts, has_flowed_);
  for (std::int32_t a = 0; a < n; ++a)
    blind_[a] = is_at_wall[a] && (neighbours[a] >= LooseParticles::fewest_neighbours || loose_.is(a));
  for (std::int32_t a = 0; a < n; ++a)
    if (is_at_wall[a] && model.soils[model.particles.soil[a]].flows()) at_walls_.push_back(a);
}

void FlowingSoil::diffuse_stress(const ReferenceConfiguration& r, Model& model, double dt) {
  constexpr double per_rate = 10, most = 0.1, negligible = 1e-6;
  Particles& p = model.particles;
  const auto n = static_cast<std::int32_t>(p.size());
  const double h2 = model.smoothing_length * model.smoothing_length;
  std::vector<std::uint8_t> shears(n), near(n);
  bool any = false;
  for (std::int32_t a = 0; a < n; ++a)
    any |= shears[a] =
        per_rate * dt * shear_rate_[a] > negligible && model.soils[p.soil[a]].flows() && !loose_.is(a);
  if (!any) return;
  const auto share_stress = [&](std::int32_t a, std::int32_t b) {
    return b < n && p.soil[b] == p.soil[a] && !loose_.is(b);
  };
  std::vector<Gradient4> gradient(n);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    near[a] = shears[a];
    if (loose_.is(a)) continue;
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry&) {
      if (share_stress(a, b)) near[a] |= shears[b];
    });
    if (!near[a]) continue;
    const Vec4 own = vector(p.stress[a]);
    Gradient4 sum = Gradient4::Zero();
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (!share_stress(a, b)) return;
      sum += (vector(p.stress[b]) - own) * Eigen::RowVector2d(g.x, g.y);
    });
    gradient[a] = sum * correction_[a].transpose();
  }
  std::vector<Vec4> change(n, Vec4::Zero());
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a) {
    if (!near[a]) continue;
    const Vec4 own = vector(p.stress[a]);
    r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
      if (!share_stress(a, b) || !(shears[a] || shears[b])) return;
      const double d = std::min(0.5 * per_rate * dt * (shear_rate_[a] + shear_rate_[b]), most) * h2;
      const Vec2 way = r.points[b] - r.points[a];
      change[a] += 2 * d * g.w * (vector(p.stress[b]) - own - 0.5 * (gradient[a] + gradient[b]) * way);
    });
  }
  work_.diffusion += deterministic_sum(n, [&](std::size_t a) {
    if (!near[a]) return 0.0;
    const Soil& soil = model.soils[p.soil[a]];
    Stress& s = p.stress[a];
    const double before = soil.stored_energy(s);
    s = s + Stress{change[a][0], change[a][1], change[a][2], change[a][3]};
    return p.volume(a) * (before - soil.stored_energy(s));
  });
}

Mat2 FlowingSoil::own_gradient(const ReferenceConfiguration& r, const Particles& p, std::int32_t a) const {
  const auto n = static_cast<std::int32_t>(r.particles());
  Mat2 sum = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    if (b < n) sum += (p.velocity[b] - p.velocity[a]) * Eigen::RowVector2d(g.x, g.y);
  });
  return sum * correction_[a].transpose();
}

Mat2 FlowingSoil::gradient_with_walls(const ReferenceConfiguration& r, const Particles& p,
                                      std::int32_t a) const {
  const auto n = static_cast<std::int32_t>(r.particles());
  Mat2 sum = Mat2::Zero();
  r.stencils.for_neighbours(a, [&](std::int32_t b, const PairGeometry& g) {
    const Vec2 v = b < n ? p.velocity[b]
                         : r.ghosts.from_root<Mirrors::motion>(b - n, Vec2(p.velocity[r.ghosts.root(b - n)]));
    sum += (v - p.velocity[a]) * Eigen::RowVector2d(g.x, g.y);
  });
  return sum * r.correction[a].transpose();
}

void FlowingSoil::leave_out_walls(const ReferenceConfiguration& r, const Particles& p, PlaneTensors& flux,
                                  std::span<Record> records) const {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < at_walls_.size(); ++k) {
    const std::int32_t a = at_walls_[k];
    if (!blind_[a]) continue;
    flux.set(a, flux[a] + viscosity_[a] * (gradient_with_walls(r, p, a) - own_gradient(r, p, a)));
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
    const Mat2 gradient = blind_[a] ? own_gradient(r, p, a) : gradient_with_walls(r, p, a);
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
void FlowingSoil::sample_control(const ReferenceConfiguration& r, const Particles& p) {
  sample_.acceleration.clear();
  if (!sample_.due()) return;
  const auto n = static_cast<std::int32_t>(r.particles());
  std::vector<Mat2> gradient(n);
#pragma omp parallel for schedule(static)
  for (std::int32_t a = 0; a < n; ++a)
    gradient[a] = blind_[a] ? own_gradient(r, p, a) : gradient_with_walls(r, p, a);
  sample_.acceleration.assign(n, Vec2::Zero());
  sample_.velocity = p.velocity;
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

void FlowingSoil::count_control(const Particles& p, double dt) { work_.control += sample_.taken(p, dt); }

void FlowingSoil::visit(StateArchive& state) {
  if (!active()) return;
  state.array("rest_density", rest_density_);
  state.array("control_viscosity", std::span(viscosity_).first(rest_density_.size()));
  state.array("shear_rate", shear_rate_);
  state.value("has_flowed", has_flowed_);
  state.value("control_samples", sample_.steps);
  loose_.walls().visit(state);
  for (double* work : {&work_.plastic, &work_.viscous, &work_.control, &work_.diffusion, &work_.shift,
                       &work_.beyond_linear_at_start})
    state.value("work", *work);
}

}  // namespace porosph
