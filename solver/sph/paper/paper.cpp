#include "solver/sph/paper/paper.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/space/parallel.hpp"
#include "solver/sph/correction/kernel_correction.hpp"
#include "solver/sph/stabilisation/artificial_stress.hpp"

namespace porosph {

PaperDynamics::PaperDynamics(const FormulationCase& formulation, Model& model, VectorUnits units)
    : model_(model),
      formulation_(formulation),
      form_(formulation.motion),
      viscosity_{formulation.artificial_viscosity_alpha, formulation.artificial_viscosity_beta},
      kernel_(model.smoothing_length),
      kernels_(paper_kernels(units)),
      soils_(model),
      skin_(0.2 * model.spacing),
      artificial_exponent_(kernel_.value(0) / kernel_.value(model.spacing)) {
  if (!model.visibility.ghosts_everywhere())
    throw std::runtime_error(
        "formulation.motion: the paper's forms do not know what to do with thin plates and corners "
        "of walls that are not right angles inwards; use \"consistent\", or a finer particles.spacing");
  make_virtual_particles();
}

/// Mirror images of the soil as it lies at first, in the fixed walls and from there in the rollers (corners).
void PaperDynamics::make_virtual_particles() {
  const auto& walls = model_.walls;
  fixed_walls_ =
      std::count_if(walls.begin(), walls.end(), [](const Wall& w) { return w.kind == BoundaryKind::fixed; });
  const std::size_t n = model_.particles.size();
  std::vector<Vec2> points = model_.particles.position;
  std::vector<Image> images;
  const double reach = kernel_.support() + skin_;
  append_images(walls, 0, fixed_walls_, reach, points, images);
  const std::size_t in_fixed = images.size();
  std::vector<Vec2> virtuals(points.begin() + static_cast<std::ptrdiff_t>(n), points.end());
  std::vector<Image> in_rollers;
  append_images(walls, fixed_walls_, walls.size(), reach, virtuals, in_rollers);
  for (const Image& i : in_rollers) images.push_back({i.parent + static_cast<std::int32_t>(n), i.wall});

  virtual_points_ = virtuals;
  const std::vector<std::int32_t> root = roots(images, n);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::size_t parent = images[i].parent;
    virtual_volume_.push_back(parent < n ? model_.particles.volume(parent) : virtual_volume_[parent - n]);
    virtual_wall_.push_back(i < in_fixed ? images[i].wall : virtual_wall_[parent - n]);
    virtual_pressure_.push_back(
        model_.water.pore_pressure_behind_wall(model_.particles.position[root[i]], virtuals[i]));
  }
}

void PaperDynamics::prepare() {
  const auto& position = model_.particles.position;
  const double moved =
      largest_of(searched_.size(), [&](std::size_t a) { return (position[a] - searched_[a]).squaredNorm(); });
  if (searched_.empty() || !(moved < 0.25 * skin_ * skin_)) search();
  move_ghosts();
  make_gradients();
}

void PaperDynamics::search() {
  const auto& position = model_.particles.position;
  const std::size_t n = position.size();
  const double reach = kernel_.support() + skin_;
  searched_ = position;
  points_ = position;
  ghosts_ = Ghosts(model_.walls, fixed_walls_, model_.walls.size(), reach, points_);
  neighbours_ = find_neighbours(points_, n, reach);
  if (!model_.visibility.everywhere())
    neighbours_ = kept(neighbours_, [&](std::int32_t a, std::int32_t b) {
      return b >= static_cast<std::int32_t>(n) || model_.visibility.sees(a, b, model_.particles);
    });
  wall_neighbours_ = find_neighbours(position, virtual_points_, reach);
  runs_ = make_pair_runs(neighbours_);
  make_room();
  connect_arrays();
  ++counts.searches;
}

void PaperDynamics::make_room() {
  const std::size_t n = searched_.size(), all = points_.size();
  wall_gradient_.resize(wall_neighbours_.index.size());
  stickiness_.resize(wall_neighbours_.index.size());
  for (auto& l : correction_) l.resize(n);
  for (auto& w : wall_velocity_) w.assign(n, 0);
  gradient_sum_.resize(n);
  wall_sums_.assign(n, {});  // most particles are far from walls
  for (auto& s : sum_) s.resize(n);
  for (auto& x : position_) x.resize(all);
  for (auto& v : velocity_) v.resize(all);
  for (auto& s : stress_) s.resize(all);
  for (auto* numbers : {&volume_, &density_, &sound_, &pressure_}) numbers->resize(all);
  weight_.resize(static_cast<std::size_t>(runs_.weights / PairRuns::widest));
  artificial_stress_.assign(all, Eigen::Vector3d::Zero());
}

void PaperDynamics::connect_arrays() {
  PaperArrays& c = arrays_;
  c.runs = &runs_;
  c.smoothing_length = kernel_.h;
  c.slope = kernel_.alpha / (kernel_.h * kernel_.h);
  c.viscosity_alpha = viscosity_.alpha, c.viscosity_beta = viscosity_.beta;
  c.rho_squared = form_.stress_over_rho_squared;
  for (int k = 0; k < 2; ++k) c.position[k] = position_[k].data(), c.velocity[k] = velocity_[k].data();
  c.volume = volume_.data(), c.density = density_.data(), c.sound = sound_.data();
  for (int k = 0; k < 3; ++k) c.stress[k] = stress_[k].data();
  c.pressure = pressure_.data();
  for (int k = 0; k < 4; ++k) c.correction[k] = correction_[k].data();
  for (int k = 0; k < 2; ++k) c.wall_velocity[k] = wall_velocity_[k].data();
  c.weight = reinterpret_cast<double*>(weight_.data());
  for (int k = 0; k < PaperArrays::sums; ++k) c.sum[k] = sum_[k].data();
}

void PaperDynamics::move_ghosts() {
  const auto& position = model_.particles.position;
  const std::size_t n = position.size();
  double *x = position_[0].data(), *y = position_[1].data();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    points_[a] = position[a];
    x[a] = position[a].x(), y[a] = position[a].y();
  }
  ghosts_.for_each([&](std::size_t i) {
    const Vec2 ghost = points_[n + i] = ghosts_.wall(i).mirrored(points_[ghosts_.parent(i)]);
    x[n + i] = ghost.x(), y[n + i] = ghost.y();
  });
}

void PaperDynamics::make_gradients() {
  const Particles& p = model_.particles;
  const double *mass = p.mass.data(), *rho = p.density.data();
  double *volume = volume_.data(), *density = density_.data(), *sound = sound_.data();
  std::vector<double> shear_moduli;
  for (const Soil& soil : model_.soils) shear_moduli.push_back(soil.shear_modulus());
  const double* shear = shear_moduli.data();
  const std::int32_t* soil = p.soil.data();
#pragma omp parallel for simd schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    volume[a] = mass[a] / rho[a];
    density[a] = rho[a];
    sound[a] = std::sqrt(shear[soil[a]] / rho[a]);  // eq. (16)
  }
  for (std::vector<double>* scalars : {&volume_, &density_, &sound_}) ghosts_.fill<Mirrors::scalar>(*scalars);
#pragma omp parallel for schedule(static)
  for (std::int32_t run = 0; run < runs_.count(); ++run) {
    kernels_.geometry(arrays_, run);
    for (std::int32_t a = runs_.runs[run].first; a < runs_.runs[run].last; ++a) correct(a);
  }
  ++counts.refreshes;
}

/// L of eq. (10) and the sums of the corrected gradients.
void PaperDynamics::correct(std::size_t a) {
  const bool at_wall = wall_neighbours_.begin[a] < wall_neighbours_.begin[a + 1];
  const double xy = sum_[PaperArrays::moment_xy][a];
  Mat2 moment =
      (Mat2() << sum_[PaperArrays::moment_xx][a], xy, xy, sum_[PaperArrays::moment_yy][a]).finished();
  if (at_wall) moment += make_wall_gradients(a);
  const Mat2 l = formulation_.kernel_correction ? correction_matrix(moment) : Mat2(Mat2::Identity());
  correction_[0][a] = l(0, 0), correction_[1][a] = l(0, 1);
  correction_[2][a] = l(1, 0), correction_[3][a] = l(1, 1);
  gradient_sum_[a] = corrected(a, PaperArrays::gradient_x, PaperArrays::gradient_y);
  if (at_wall) sum_wall_gradients(a);
}

/// Uncorrected gradients of the pairs with virtual particles; returns sum g (x) (x_b - x_a).
Mat2 PaperDynamics::make_wall_gradients(std::size_t a) {
  Mat2 moment = Mat2::Zero();
  for (std::int64_t k = wall_neighbours_.begin[a]; k < wall_neighbours_.begin[a + 1]; ++k) {
    const std::int32_t b = wall_neighbours_.index[k];
    const Vec2 to_b = virtual_points_[b] - points_[a];
    wall_gradient_[k] = -virtual_volume_[b] * kernel_.slope(to_b.norm()) * to_b;
    moment += wall_gradient_[k] * to_b.transpose();
  }
  return moment;
}

void PaperDynamics::sum_wall_gradients(std::size_t a) {
  WallSums walls;
  Vec2 velocity = Vec2::Zero();
  for (std::int64_t k = wall_neighbours_.begin[a]; k < wall_neighbours_.begin[a + 1]; ++k) {
    const std::int32_t b = wall_neighbours_.index[k];
    const Wall& wall = model_.walls[virtual_wall_[b]];
    const Vec2 g = corrected(a, wall_gradient_[k]);
    wall_gradient_[k] = g;
    const double mine = wall.distance(points_[a]), its = -wall.distance(virtual_points_[b]);
    stickiness_[k] = 1 + (its < 0.5 * mine ? its / mine : 0.5);
    walls.gradient += g;
    velocity += stickiness_[k] * g;
    walls.pressure += virtual_pressure_[b] * g;
  }
  wall_sums_[a] = walls;
  wall_velocity_[0][a] = velocity.x(), wall_velocity_[1][a] = velocity.y();
}

/// L of particle a times a vector.
Vec2 PaperDynamics::corrected(std::size_t a, const Vec2& v) const {
  return {correction_[0][a] * v.x() + correction_[1][a] * v.y(),
          correction_[2][a] * v.x() + correction_[3][a] * v.y()};
}

/// The same of the vector whose components are these sums.
Vec2 PaperDynamics::corrected(std::size_t a, int x, int y) const {
  return corrected(a, Vec2(sum_[x][a], sum_[y][a]));
}

void PaperDynamics::fill_ghost_velocities() {
  const auto& v = model_.particles.velocity;
  double *x = velocity_[0].data(), *y = velocity_[1].data();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < v.size(); ++a) x[a] = v[a].x(), y[a] = v[a].y();
  ghosts_.fill<Mirrors::motion>([&](std::size_t k) { return Vec2(x[k], y[k]); },
                                [&](std::size_t k, const Vec2& u) { x[k] = u.x(), y[k] = u.y(); });
}

void PaperDynamics::fill_stress() {
  const Particles& p = model_.particles;
  double *xx = stress_[0].data(), *yy = stress_[1].data(), *xy = stress_[2].data(),
         *pressure = pressure_.data();
  const bool per_density = form_.stress_over_rho_squared;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Stress& s = p.stress[a];
    const double scale = per_density ? 1 / p.density[a] : 1;
    xx[a] = s.xx * scale, yy[a] = s.yy * scale, xy[a] = s.xy * scale;
    pressure[a] = p.pore_pressure[a];
  }
  ghosts_.fill<Mirrors::tensor>(
      [&](std::size_t k) { return (Mat2() << xx[k], xy[k], xy[k], yy[k]).finished(); },
      [&](std::size_t k, const Mat2& s) { xx[k] = s(0, 0), yy[k] = s(1, 1), xy[k] = s(0, 1); });
  ghosts_.for_each([&](std::size_t i) {
    const std::size_t ghost = p.size() + i;
    pressure[ghost] = model_.water.pore_pressure_behind_wall(p.position[ghosts_.root(i)], points_[ghost]);
  });
  if (per_density) return;
#pragma omp parallel for simd schedule(static)
  for (std::size_t i = 0; i < points_.size(); ++i) xx[i] += pressure[i], yy[i] += pressure[i];
}

void PaperDynamics::fill_artificial_stress() {
  const Particles& p = model_.particles;
  any_tension_ = false;
  if (formulation_.artificial_stress == 0) return;
  bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
  for (std::size_t a = 0; a < p.size(); ++a) {
    artificial_stress_[a] = artificial_stress(p.stress[a], p.density[a], formulation_.artificial_stress);
    any = any || !artificial_stress_[a].isZero(0);
  }
  any_tension_ = any;
  auto& r = artificial_stress_;
  ghosts_.fill<Mirrors::tensor>(
      [&](std::size_t k) { return (Mat2() << r[k][0], r[k][2], r[k][2], r[k][1]).finished(); },
      [&](std::size_t k, const Mat2& m) {
        r[k] = {m(0, 0), m(1, 1), m(0, 1)};
      });
}

/// The sums of eqs. (17), (24) and (25) without C_ab.
Vec2 PaperDynamics::stress_and_pressure(std::size_t a) const {
  using Sums = PaperArrays;
  const Particles& p = model_.particles;
  const double rho = p.density[a];
  const Mat2 stress = p.stress[a].in_plane();
  const WallSums& walls = wall_sums_[a];
  const Vec2 of_xx = corrected(a, Sums::xx_x, Sums::xx_y), of_xy = corrected(a, Sums::xy_x, Sums::xy_y),
             of_yy = corrected(a, Sums::yy_x, Sums::yy_y);
  const Vec2 others(of_xx.x() + of_xy.y(), of_xy.x() + of_yy.y());
  const Vec2 all = gradient_sum_[a] + walls.gradient;
  const Vec2 pressure = walls.pressure + form_.own_pressure * p.pore_pressure[a] * all;

  if (!form_.stress_over_rho_squared)
    return (others + stress * (gradient_sum_[a] + 2 * walls.gradient) + pressure) / rho;
  const Vec2 of_pressure = corrected(a, Sums::pressure_x, Sums::pressure_y),
             of_density = corrected(a, Sums::density_x, Sums::density_y);
  return others + stress * of_density / (rho * rho) +
         (2 * stress * walls.gradient + of_pressure + pressure) / rho;
}

/// sum_b m_b C_ab grad W_ab over particles and ghosts: artificial viscosity.
Vec2 PaperDynamics::viscous(std::size_t a) const {
  return -corrected(a, PaperArrays::viscous_x, PaperArrays::viscous_y);
}

/// The same: artificial stress.
Vec2 PaperDynamics::tension_control(std::size_t a) const {
  const double at_spacing = kernel_.value(model_.spacing);
  Vec2 force = Vec2::Zero();
  for (const std::int32_t b : neighbours_.of(a)) {
    const Eigen::Vector3d r = artificial_stress_[a] + artificial_stress_[b];
    if (r.isZero(0)) continue;
    const Vec2 to_b = points_[b] - points_[a];
    const double distance = to_b.norm();
    const Vec2 g = -volume_[b] * kernel_.slope(distance) * corrected(a, to_b);
    const double f = std::pow(kernel_.value(distance) / at_spacing, artificial_exponent_);
    force += density_[b] * f * Vec2(r[0] * g.x() + r[2] * g.y(), r[2] * g.x() + r[1] * g.y());
  }
  return force;
}

/// The same over virtual particles, which have the density, the stress and the soil of particle a.
Vec2 PaperDynamics::stabilisation_at_walls(std::size_t a) const {
  const Particles& p = model_.particles;
  const double rho = p.density[a], at_spacing = kernel_.value(model_.spacing);
  Vec2 force = Vec2::Zero();
  for (std::int64_t k = wall_neighbours_.begin[a]; k < wall_neighbours_.begin[a + 1]; ++k) {
    const Vec2 x = points_[a] - virtual_points_[wall_neighbours_.index[k]],
               v = stickiness_[k] * model_.particles.velocity[a];
    const Vec2& g = wall_gradient_[k];
    force -= rho * viscosity_.pair(v.dot(x), x.squaredNorm(), kernel_.h, sound_[a], rho) * g;
    if (!any_tension_) continue;
    const Eigen::Vector3d r = 2 * artificial_stress_[a];
    const double f = std::pow(kernel_.value(x.norm()) / at_spacing, artificial_exponent_);
    force += rho * f * Vec2(r[0] * g.x() + r[2] * g.y(), r[2] * g.x() + r[1] * g.y());
  }
  return force;
}

void PaperDynamics::accelerations(std::span<Vec2> out) {
  fill_ghost_velocities();
  fill_stress();
  fill_artificial_stress();
  const bool stabilised = viscosity_.active() || any_tension_;
#pragma omp parallel for schedule(static)
  for (std::int32_t run = 0; run < runs_.count(); ++run) {
    kernels_.forces(arrays_, run);
    for (std::int32_t a = runs_.runs[run].first; a < runs_.runs[run].last; ++a) {
      out[a] = stress_and_pressure(a) + model_.gravity;
      if (viscosity_.active()) out[a] += viscous(a);
      if (any_tension_) out[a] += tension_control(a);
      if (stabilised) out[a] += stabilisation_at_walls(a);
    }
  }
}

void PaperDynamics::velocity_gradients(std::span<Mat2> out) {
  using Sums = PaperArrays;
  fill_ghost_velocities();
#pragma omp parallel for schedule(static)
  for (std::int32_t run = 0; run < runs_.count(); ++run) {
    kernels_.rates(arrays_, run);
    for (std::int32_t a = runs_.runs[run].first; a < runs_.runs[run].last; ++a)
      out[a] << sum_[Sums::rate_xx][a], sum_[Sums::rate_xy][a], sum_[Sums::rate_yx][a],
          sum_[Sums::rate_yy][a];
  }
}

void PaperDynamics::strain(double dt) {
  fill_ghost_velocities();
  arrays_.soils = soils_.view();
  arrays_.effective_stress = &model_.particles.stress.data()->xx;
  arrays_.own_density = model_.particles.density.data();
#pragma omp parallel for schedule(static)
  for (std::int32_t run = 0; run < runs_.count(); ++run) kernels_.strain(arrays_, run, dt);
}

/// Neighbours and ghosts are those of the last search; the rest is made anew in every step.
void PaperDynamics::visit(StateArchive& state) {
  bool has_searched = !searched_.empty();
  state.value("has_searched", has_searched);
  if (!has_searched) return;
  std::vector<Vec2> then = searched_;
  then.resize(model_.particles.size());
  state.array("searched", then);
  if (!state.restoring()) return;
  model_.particles.position.swap(then);
  search();
  model_.particles.position.swap(then);
}

}  // namespace porosph
