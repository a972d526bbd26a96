#include "solver/motion/paper.hpp"

#include <algorithm>
#include <cmath>

#include "solver/correction/kernel_correction.hpp"
#include "solver/motion/soil_step.hpp"
#include "solver/stabilisation/artificial_stress.hpp"

namespace porosph {
namespace {

enum : int { s_xx, s_yy, s_xy, pressure, density };  // lanes of a record

}  // namespace

PaperDynamics::PaperDynamics(const FormulationCase& formulation, Model& model)
    : model_(model),
      formulation_(formulation),
      form_(formulation.motion),
      viscosity_{formulation.artificial_viscosity_alpha, formulation.artificial_viscosity_beta},
      kernel_(model.smoothing_length),
      skin_(0.2 * model.spacing),
      artificial_exponent_(kernel_.value(0) / kernel_.value(model.spacing)) {
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
  double moved = searched_.empty() ? never : 0;
  for (std::size_t a = 0; a < searched_.size(); ++a)
    moved = std::max(moved, (position[a] - searched_[a]).squaredNorm());
  if (!(moved < 0.25 * skin_ * skin_)) search();
  move_ghosts();
  make_gradients();
}

void PaperDynamics::search() {
  const auto& position = model_.particles.position;
  const std::size_t n = position.size();
  const double reach = kernel_.support() + skin_;
  searched_ = position;
  points_ = position;
  ghosts_.clear();
  append_images(model_.walls, fixed_walls_, model_.walls.size(), reach, points_, ghosts_);
  ghost_root_ = roots(ghosts_, n);
  neighbours_ = find_neighbours(points_, n, reach);
  wall_neighbours_ = find_neighbours(position, virtual_points_, reach);
  gradient_.resize(neighbours_.index.size());
  wall_gradient_.resize(wall_neighbours_.index.size());
  stickiness_.resize(wall_neighbours_.index.size());
  gradient_sum_.resize(n);
  wall_sums_.resize(n);
  records_.resize(points_.size());
  volume_.resize(points_.size());
  density_.resize(points_.size());
  sound_.resize(points_.size());
  velocities_.resize(points_.size());
  artificial_stress_.assign(points_.size(), Eigen::Vector3d::Zero());
  ++counts.searches;
}

void PaperDynamics::move_ghosts() {
  const auto& position = model_.particles.position;
  std::copy(position.begin(), position.end(), points_.begin());
  for (std::size_t i = 0; i < ghosts_.size(); ++i)
    points_[position.size() + i] = model_.walls[ghosts_[i].wall].mirrored(points_[ghosts_[i].parent]);
}

void PaperDynamics::make_gradients() {
  const Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    volume_[a] = p.volume(a);
    density_[a] = p.density[a];
    sound_[a] = std::sqrt(model_.soils[p.soil[a]].shear_modulus / p.density[a]);  // eq. (16)
  }
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    const std::size_t ghost = p.size() + i, parent = ghosts_[i].parent;
    volume_[ghost] = volume_[parent], density_[ghost] = density_[parent], sound_[ghost] = sound_[parent];
  }
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < p.size(); ++a) make_gradients_of(a);
  ++counts.refreshes;
}

/// Uncorrected G_ab of a particle at `here`; returns sum_b G_ab (x) (x_b - x_a).
Mat2 PaperDynamics::raw_gradients(const Vec2& here, std::span<const std::int32_t> index, const Vec2* points,
                                  const double* volumes, PairGradient* gradient) const {
  const CubicSpline<2> kernel = kernel_;
  const double* coordinates = points->data();
  const double ax = here.x(), ay = here.y();
  const std::int32_t* neighbour = index.data();
  const auto count = static_cast<std::int64_t>(index.size());
  double xx = 0, xy = 0, yy = 0;
#pragma omp simd reduction(+ : xx, xy, yy)
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t b = neighbour[k];
    const double dx = coordinates[2 * b] - ax, dy = coordinates[2 * b + 1] - ay;
    const double weight = -volumes[b] * kernel.slope(std::sqrt(dx * dx + dy * dy));
    gradient[k].x = weight * dx, gradient[k].y = weight * dy;
    xx += weight * dx * dx, xy += weight * dx * dy, yy += weight * dy * dy;
  }
  return (Mat2() << xx, xy, xy, yy).finished();
}

/// G_ab of all pairs of particle a, corrected by L of eq. (10), and their sums.
void PaperDynamics::make_gradients_of(std::size_t a) {
  const Vec2 here = points_[a];
  const std::int64_t first = neighbours_.begin[a], last = neighbours_.begin[a + 1];
  const std::int64_t wall_first = wall_neighbours_.begin[a], wall_last = wall_neighbours_.begin[a + 1];
  Mat2 sum = raw_gradients(here, neighbours_.of(a), points_.data(), volume_.data(), gradient_.data() + first);
  if (wall_first < wall_last)
    sum += raw_gradients(here, wall_neighbours_.of(a), virtual_points_.data(), virtual_volume_.data(),
                         wall_gradient_.data() + wall_first);
  const Mat2 correction = formulation_.kernel_correction ? correction_matrix(sum) : Mat2(Mat2::Identity());

  const double cxx = correction(0, 0), cxy = correction(0, 1), cyx = correction(1, 0), cyy = correction(1, 1);
  PairGradient* gradient = gradient_.data();
  double total_x = 0, total_y = 0;
#pragma omp simd reduction(+ : total_x, total_y)
  for (std::int64_t k = first; k < last; ++k) {
    const double gx = cxx * gradient[k].x + cxy * gradient[k].y,
                 gy = cyx * gradient[k].x + cyy * gradient[k].y;
    gradient[k].x = gx, gradient[k].y = gy;
    total_x += gx, total_y += gy;
  }
  gradient_sum_[a] = Vec2(total_x, total_y);
  wall_sums_[a] = {};
  if (wall_first == wall_last) return;

  WallSums walls;
  for (std::int64_t k = wall_first; k < wall_last; ++k) {
    const std::int32_t b = wall_neighbours_.index[k];
    const Wall& wall = model_.walls[virtual_wall_[b]];
    const Vec2 g = correction * Vec2(wall_gradient_[k].x, wall_gradient_[k].y);
    wall_gradient_[k] = {g.x(), g.y()};
    const double mine = wall.distance(here), its = -wall.distance(virtual_points_[b]);
    stickiness_[k] = 1 + (its < 0.5 * mine ? its / mine : 0.5);
    walls.gradient += g;
    walls.velocity += stickiness_[k] * g;
    walls.pressure += virtual_pressure_[b] * g;
  }
  wall_sums_[a] = walls;
}

void PaperDynamics::fill_ghost_velocities() {
  const auto& v = model_.particles.velocity;
  std::copy(v.begin(), v.end(), velocities_.begin());
  for (std::size_t i = 0; i < ghosts_.size(); ++i)
    velocities_[v.size() + i] = model_.walls[ghosts_[i].wall].reflection() * velocities_[ghosts_[i].parent];
}

void PaperDynamics::fill_records() {
  const Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Stress& s = p.stress[a];
    const double scale = form_.stress_over_rho_squared ? 1 / p.density[a] : 1;
    Lanes& q = records_[a].q;
    q[s_xx] = s.xx * scale, q[s_yy] = s.yy * scale, q[s_xy] = s.xy * scale;
    q[pressure] = p.pore_pressure[a];
    q[density] = p.density[a];
  }
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    Lanes q = records_[ghosts_[i].parent].q;
    const Mat2 r = model_.walls[ghosts_[i].wall].reflection();
    const Mat2 s = r * (Mat2() << q[s_xx], q[s_xy], q[s_xy], q[s_yy]).finished() * r;
    q[s_xx] = s(0, 0), q[s_yy] = s(1, 1), q[s_xy] = s(0, 1);
    q[pressure] = model_.water.pore_pressure_behind_wall(p.position[ghost_root_[i]], points_[p.size() + i]);
    records_[p.size() + i].q = q;
  }
}

void PaperDynamics::fill_artificial_stress() {
  const Particles& p = model_.particles;
  any_tension_ = false;
  if (formulation_.artificial_stress == 0) return;
  for (std::size_t a = 0; a < p.size(); ++a) {
    artificial_stress_[a] = artificial_stress(p.stress[a], p.density[a], formulation_.artificial_stress);
    any_tension_ = any_tension_ || !artificial_stress_[a].isZero(0);
  }
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    const Eigen::Vector3d& parent = artificial_stress_[ghosts_[i].parent];
    const Mat2 r = model_.walls[ghosts_[i].wall].reflection();
    const Mat2 mirrored = r * (Mat2() << parent[0], parent[2], parent[2], parent[1]).finished() * r;
    artificial_stress_[p.size() + i] = {mirrored(0, 0), mirrored(1, 1), mirrored(0, 1)};
  }
}

/// The sums of eqs. (17), (24) and (25) without C_ab.
Vec2 PaperDynamics::stress_and_pressure(std::size_t a) const {
  const Record* records = records_.data();
  const std::int32_t* index = neighbours_.index.data();
  const PairGradient* gradient = gradient_.data();
  const std::int64_t last = neighbours_.begin[a + 1];
  PairSums sums, sums2;  // two of each: an addition need not wait for the one before
  std::int64_t k = neighbours_.begin[a];
  for (; k + 1 < last; k += 2) {
    const Lanes q = records[index[k]].q, q2 = records[index[k + 1]].q;
    sums.x += q * gradient[k].x, sums2.x += q2 * gradient[k + 1].x;
    sums.y += q * gradient[k].y, sums2.y += q2 * gradient[k + 1].y;
  }
  if (k < last) sums.x += records[index[k]].q * gradient[k].x, sums.y += records[index[k]].q * gradient[k].y;
  sums.x += sums2.x, sums.y += sums2.y;
  const Particles& p = model_.particles;
  const double rho = p.density[a];
  const Mat2 stress = p.stress[a].in_plane();
  const WallSums& walls = wall_sums_[a];
  const Vec2 others(sums.x[s_xx] + sums.y[s_xy], sums.x[s_xy] + sums.y[s_yy]);
  const Vec2 all = gradient_sum_[a] + walls.gradient;
  const Vec2 pressure_sum = Vec2(sums.x[pressure], sums.y[pressure]) + walls.pressure +
                            form_.own_pressure * p.pore_pressure[a] * all;

  if (!form_.stress_over_rho_squared)
    return (others + stress * (gradient_sum_[a] + 2 * walls.gradient) + pressure_sum) / rho;
  const Vec2 weighted(sums.x[density], sums.y[density]);
  return others + stress * weighted / (rho * rho) + (2 * stress * walls.gradient + pressure_sum) / rho;
}

/// sum_b m_b C_ab grad W_ab over particles and ghosts: artificial viscosity.
Vec2 PaperDynamics::viscous(std::size_t a) const {
  const ArtificialViscosity viscosity = viscosity_;
  const double* x = points_[0].data();
  const double* v = velocities_[0].data();
  const std::int32_t* index = neighbours_.index.data();
  const PairGradient* gradient = gradient_.data();
  const double *density = density_.data(), *sound = sound_.data();
  const double ax = points_[a].x(), ay = points_[a].y(), avx = velocities_[a].x(), avy = velocities_[a].y();
  const double rho_a = density[a], c_a = sound[a], h = kernel_.h;
  double force_x = 0, force_y = 0;
#pragma omp simd reduction(+ : force_x, force_y)
  for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
    const std::int64_t b = index[k];
    const double dx = ax - x[2 * b], dy = ay - x[2 * b + 1];
    const double vx = (avx - v[2 * b]) * dx + (avy - v[2 * b + 1]) * dy;
    const double pi =
        viscosity.pair(vx, dx * dx + dy * dy, h, 0.5 * (c_a + sound[b]), 0.5 * (rho_a + density[b]));
    force_x -= density[b] * pi * gradient[k].x;
    force_y -= density[b] * pi * gradient[k].y;
  }
  return {force_x, force_y};
}

/// The same: artificial stress.
Vec2 PaperDynamics::tension_control(std::size_t a) const {
  const double at_spacing = kernel_.value(model_.spacing);
  Vec2 force = Vec2::Zero();
  for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
    const std::int32_t b = neighbours_.index[k];
    const Eigen::Vector3d r = artificial_stress_[a] + artificial_stress_[b];
    if (r.isZero(0)) continue;
    const PairGradient g = gradient_[k];
    const double distance = (points_[a] - points_[b]).norm();
    const double f = std::pow(kernel_.value(distance) / at_spacing, artificial_exponent_);
    force += density_[b] * f * Vec2(r[0] * g.x + r[2] * g.y, r[2] * g.x + r[1] * g.y);
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
               v = stickiness_[k] * velocities_[a];
    const Vec2 g(wall_gradient_[k].x, wall_gradient_[k].y);
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
  fill_records();
  fill_artificial_stress();
  const bool stabilised = viscosity_.active() || any_tension_;
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < model_.particles.size(); ++a) {
    out[a] = stress_and_pressure(a) + model_.gravity;
    if (viscosity_.active()) out[a] += viscous(a);
    if (any_tension_) out[a] += tension_control(a);
    if (stabilised) out[a] += stabilisation_at_walls(a);
  }
}

/// sum_b V_b (v_b - v_a) (x) L_a grad W_ab, of which eqs. (29) and (31) are the symmetric and the skew part.
Mat2 PaperDynamics::velocity_gradient(std::size_t a) const {
  const Vec2 own = gradient_sum_[a] + wall_sums_[a].velocity;  // what sticks to a wall moves against v_a
  return velocity_sum(neighbours_, gradient_.data(), velocities_.data(), own, a);
}

void PaperDynamics::velocity_gradients(std::span<Mat2> out) {
  fill_ghost_velocities();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < model_.particles.size(); ++a) out[a] = velocity_gradient(a);
}

void PaperDynamics::strain(double dt) {
  fill_ghost_velocities();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < model_.particles.size(); ++a) {
    const Mat2 gradient = mid_step_gradient(velocity_gradient(a), dt);
    update_stress(model_, a, gradient, dt);
    update_density(model_.particles, a, gradient, dt);
  }
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
