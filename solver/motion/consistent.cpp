#include "solver/motion/consistent.hpp"

#include <algorithm>
#include <cmath>

#include "solver/correction/kernel_correction.hpp"
#include "solver/motion/soil_step.hpp"
#include "solver/parallel.hpp"
#include "solver/stabilisation/bulk_viscosity.hpp"

namespace porosph {
namespace {

enum : int { t_xx, t_yx, t_xy, t_yy, pressure, v_x, v_y };  // lanes of a record

Mat2 stress_lanes(const Record& r) { return (Mat2() << r.q[t_xx], r.q[t_xy], r.q[t_yx], r.q[t_yy]).finished(); }

void set_stress_lanes(Record& r, const Mat2& t) {
  r.q[t_xx] = t(0, 0), r.q[t_yx] = t(1, 0), r.q[t_xy] = t(0, 1), r.q[t_yy] = t(1, 1);
}

/// The rate of deformation behind a wall, from that in front of it.
Mat2 image_of_rate(const Wall& wall, const Mat2& rate) {
  const Mat2 r = wall.reflection();
  return wall.kind == BoundaryKind::fixed ? Mat2(-rate * r) : Mat2(r * rate * r);
}

Vec2 image_of_velocity(const Wall& wall, const Vec2& v) {
  return wall.kind == BoundaryKind::fixed ? Vec2(-v) : Vec2(wall.reflection() * v);
}

double largest_rho_c(const Model& model) {
  double largest = 0;
  for (std::size_t i = 0; i < model.particles.size(); ++i)
    largest = std::max(largest, std::sqrt(model.soils[model.particles.soil[i]].constrained_modulus() *
                                          model.particles.density[i]));
  return largest;
}

}  // namespace

ConsistentDynamics::ConsistentDynamics(const FormulationCase& formulation, Model& model)
    : model_(model),
      formulation_(formulation),
      kernel_(model.smoothing_length),
      zero_energy_viscosity_(formulation.zero_energy_control * largest_rho_c(model) * model.smoothing_length) {}

void ConsistentDynamics::prepare() {
  const bool close = travel_ > 0.05 * model_.spacing && strangers_are_near();
  const bool due = !have_reference_ || largest_strain_ > formulation_.refresh_strain || close;
  if (due) refresh();
}

void ConsistentDynamics::refresh() {
  make_images();
  make_gradients();
  make_one_sided_gradients();
  start_from_reference();
  have_reference_ = true;
  ++counts.refreshes;
}

void ConsistentDynamics::make_images() {
  const auto& walls = model_.walls;
  const std::size_t bearing =
      std::count_if(walls.begin(), walls.end(), [](const Wall& w) { return w.bears_weight; });
  points_ = model_.particles.position;
  images_.clear();
  append_images(walls, 0, bearing, kernel_.support(), points_, images_);
  extrapolated_ = images_.size();
  append_images(walls, bearing, walls.size(), kernel_.support(), points_, images_);
  root_ = roots(images_, model_.particles.size());
}

void ConsistentDynamics::make_gradients() {
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
  neighbours_ = find_neighbours(points_, n, kernel_.support());
  ++counts.searches;

  volume_.resize(points_.size());
  reference_density_ = p.density;
  for (std::size_t a = 0; a < n; ++a) volume_[a] = p.volume(a);
  for (std::size_t i = 0; i < images_.size(); ++i) volume_[n + i] = volume_[images_[i].parent];

  gradient_.resize(neighbours_.index.size());
  weight_.resize(neighbours_.index.size());
  correction_.assign(points_.size(), Mat2::Identity());
  gradient_sum_.assign(n, Vec2::Zero());
  weight_sum_.assign(n, 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    Mat2 sum = Mat2::Zero();
    for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
      const std::int32_t b = neighbours_.index[k];
      const Vec2 to_b = points_[b] - points_[a];
      weight_[k] = -volume_[b] * kernel_.slope(to_b.norm());
      const Vec2 g = weight_[k] * to_b;
      gradient_[k] = {g.x(), g.y()};
      gradient_sum_[a] += g;
      weight_sum_[a] += weight_[k];
      sum += g * to_b.transpose();
    }
    if (formulation_.kernel_correction) correction_[a] = correction_matrix(sum);
  }
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const Mat2 r = model_.walls[images_[i].wall].reflection();
    correction_[n + i] = r * correction_[images_[i].parent] * r;
  }
}

/// Gradients at the particles next to bearing walls that see only the soil (and its mirror images at other walls), to
/// carry the stress on linearly behind the wall.
void ConsistentDynamics::make_one_sided_gradients() {
  const std::size_t n = model_.particles.size();
  std::vector<bool> stems_from_extrapolated(images_.size());
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const std::size_t parent = images_[i].parent;
    stems_from_extrapolated[i] = i < extrapolated_ || (parent >= n && stems_from_extrapolated[parent - n]);
  }
  one_sided_.clear();
  one_sided_of_.resize(extrapolated_);
  std::vector<std::int32_t> place(n, -1);
  for (std::size_t i = 0; i < extrapolated_; ++i) {
    const std::int32_t a = root_[i];
    if (place[a] >= 0) {
      one_sided_of_[i] = place[a];
      continue;
    }
    OneSided stencil{.particle = a, .neighbours = {}, .gradient = {}};
    Mat2 sum = Mat2::Zero();
    for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
      const std::int32_t b = neighbours_.index[k];
      if (b >= static_cast<std::int32_t>(n) && stems_from_extrapolated[b - n]) continue;
      const Vec2 g(gradient_[k].x, gradient_[k].y);
      stencil.neighbours.push_back(b);
      stencil.gradient.push_back(g);
      sum += g * (points_[b] - points_[a]).transpose();
    }
    const Mat2 correction = correction_matrix(sum);
    for (Vec2& g : stencil.gradient) g = correction * g;
    place[a] = one_sided_of_[i] = static_cast<std::int32_t>(one_sided_.size());
    one_sided_.push_back(std::move(stencil));
  }
}

void ConsistentDynamics::start_from_reference() {
  const std::size_t n = model_.particles.size();
  deformation_.assign(n, Mat2::Identity());
  piola_.resize(points_.size());
  records_.assign(points_.size(), Record{});
  velocities_.resize(points_.size());
  fill_image_velocities();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    const Mat2 rate = deformation_rate(a);
    write_record(a, rate, bulk_viscous(a, rate));
  }
  largest_strain_ = 0;
  travel_ = 0;
}

/// True when two particles came closer than the kernel's support, by a margin, without being neighbours.
bool ConsistentDynamics::strangers_are_near() {
  travel_ = 0;
  const auto& position = model_.particles.position;
  const std::size_t n = position.size();
  const NeighbourList now = find_neighbours(position, n, kernel_.support() - 0.2 * model_.spacing);
  ++counts.searches;
  bool found = false;
#pragma omp parallel for schedule(static) reduction(|| : found)
  for (std::size_t a = 0; a < n; ++a) {
    const auto known = neighbours_.of(a);
    for (std::int32_t b : now.of(a)) found = found || !std::binary_search(known.begin(), known.end(), b);
  }
  return found;
}

/// dF/dt = sum_b V_b (v_b - v_a) (x) L_a grad W_ab.
Mat2 ConsistentDynamics::deformation_rate(std::size_t a) const {
  double xx = 0, xy = 0, yx = 0, yy = 0;
  for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
    const Vec2& v = velocities_[neighbours_.index[k]];
    const PairGradient g = gradient_[k];
    xx += v.x() * g.x, xy += v.x() * g.y;
    yx += v.y() * g.x, yy += v.y() * g.y;
  }
  const Mat2 sum = (Mat2() << xx, xy, yx, yy).finished() - velocities_[a] * gradient_sum_[a].transpose();
  return sum * correction_[a].transpose();
}

Mat2 ConsistentDynamics::bulk_viscous(std::size_t a, const Mat2& velocity_gradient) const {
  const Particles& p = model_.particles;
  const double modulus = model_.soils[p.soil[a]].constrained_modulus();
  return bulk_viscosity(formulation_.bulk_viscosity, std::sqrt(modulus * p.density[a]) * model_.smoothing_length,
                        velocity_gradient.trace()) *
         Mat2::Identity();
}

void ConsistentDynamics::write_record(std::size_t a, const Mat2& rate, const Mat2& viscous_stress) {
  const Mat2& f = deformation_[a];
  const Mat2 cauchy = model_.particles.stress[a].in_plane() + viscous_stress;
  piola_[a] = f.determinant() * cauchy * inverse(f).transpose();
  set_stress_lanes(records_[a], piola_[a] * correction_[a] - zero_energy_viscosity_ * rate);
  records_[a].q[v_x] = velocities_[a].x();
  records_[a].q[v_y] = velocities_[a].y();
}

void ConsistentDynamics::fill_image_velocities() {
  const auto& v = model_.particles.velocity;
  std::copy(v.begin(), v.end(), velocities_.begin());
  for (std::size_t i = 0; i < images_.size(); ++i)
    velocities_[v.size() + i] = image_of_velocity(model_.walls[images_[i].wall], velocities_[images_[i].parent]);
}

void ConsistentDynamics::update_pressure_lanes() {
  const Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a) records_[a].q[pressure] = p.pore_pressure[a];
  image_positions_.resize(images_.size());
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const std::size_t parent = images_[i].parent;
    const Vec2& from = parent < p.size() ? p.position[parent] : image_positions_[parent - p.size()];
    const Vec2 here = image_positions_[i] = model_.walls[images_[i].wall].mirrored(from);
    records_[p.size() + i].q[pressure] = model_.water.pore_pressure_behind_wall(p.position[root_[i]], here);
  }
}

/// P behind a bearing wall goes on linearly from the soil in front of it; a roller carries no shear.
void ConsistentDynamics::extrapolate_stress() {
  const std::size_t n = model_.particles.size();
  std::vector<std::array<Mat2, 2>> gradients(one_sided_.size());
  for (std::size_t s = 0; s < one_sided_.size(); ++s) {
    const OneSided& stencil = one_sided_[s];
    Mat2 along_x = Mat2::Zero(), along_y = Mat2::Zero();
    for (std::size_t k = 0; k < stencil.neighbours.size(); ++k) {
      const Mat2 difference = piola_[stencil.neighbours[k]] - piola_[stencil.particle];
      along_x += difference * stencil.gradient[k].x();
      along_y += difference * stencil.gradient[k].y();
    }
    gradients[s] = {along_x, along_y};
  }
  for (std::size_t i = 0; i < extrapolated_; ++i) {
    const auto& [along_x, along_y] = gradients[one_sided_of_[i]];
    const Wall& wall = model_.walls[images_[i].wall];
    const Mat2& root = piola_[root_[i]];
    const Vec2 way = points_[n + i] - points_[root_[i]];
    Mat2 stress = root + along_x * way.x() + along_y * way.y();
    if (wall.kind == BoundaryKind::roller) {
      const Mat2 across = wall.normal * wall.normal.transpose(), along = Mat2::Identity() - across;
      const Mat2 mirrored = wall.reflection() * root * wall.reflection();
      stress = across * stress * across + along * stress * along + across * mirrored * along + along * mirrored * across;
    }
    piola_[n + i] = stress;
  }
}

void ConsistentDynamics::fill_image_records() {
  const std::size_t n = model_.particles.size();
  const auto mirror_stress = [&](std::size_t i) {
    const Mat2 r = model_.walls[images_[i].wall].reflection();
    piola_[n + i] = r * piola_[images_[i].parent] * r;
  };
  for (std::size_t i = extrapolated_; i < images_.size(); ++i) mirror_stress(i);
  extrapolate_stress();
  for (std::size_t i = extrapolated_; i < images_.size(); ++i)
    if (images_[i].parent >= static_cast<std::int32_t>(n)) mirror_stress(i);

  for (std::size_t i = 0; i < images_.size(); ++i) {
    const auto parent = static_cast<std::size_t>(images_[i].parent);
    const Mat2 viscous = stress_lanes(records_[parent]) - piola_[parent] * correction_[parent];
    Record& record = records_[n + i];
    set_stress_lanes(record,
                     piola_[n + i] * correction_[n + i] + image_of_rate(model_.walls[images_[i].wall], viscous));
    record.q[v_x] = velocities_[n + i].x();
    record.q[v_y] = velocities_[n + i].y();
  }
}

void ConsistentDynamics::accelerate_range(std::size_t first, std::size_t last, Vec2* out) const {
  const Record* records = records_.data();
  const double mu = zero_energy_viscosity_;
  for (std::size_t a = first; a < last; ++a) {
    Lanes x{}, y{}, w{};
    for (std::int64_t k = neighbours_.begin[a]; k < neighbours_.begin[a + 1]; ++k) {
      const Lanes q = records[neighbours_.index[k]].q;
      x += q * gradient_[k].x;
      y += q * gradient_[k].y;
      w += q * weight_[k];
    }
    const Lanes own = records[a].q;
    const Vec2& s = gradient_sum_[a];
    const Vec2 stress_force(x[t_xx] + y[t_xy] + own[t_xx] * s.x() + own[t_xy] * s.y(),
                            x[t_yx] + y[t_yy] + own[t_yx] * s.x() + own[t_yy] * s.y());
    const Vec2 viscous_force = 2 * mu * Vec2(w[v_x] - own[v_x] * weight_sum_[a], w[v_y] - own[v_y] * weight_sum_[a]);
    const Vec2 pressure_sum(x[pressure] - own[pressure] * s.x(), y[pressure] - own[pressure] * s.y());  // eq. (22)
    const Mat2& f = deformation_[a];
    const Vec2 pressure_force = f.determinant() * (inverse(f).transpose() * (correction_[a] * pressure_sum));
    out[a] = (stress_force + viscous_force + pressure_force) / reference_density_[a] + model_.gravity;
  }
}

void ConsistentDynamics::accelerations(std::span<Vec2> out) {
  update_pressure_lanes();
  fill_image_records();
#pragma omp parallel
  {
    const auto [first, last] = thread_range(model_.particles.size());
    accelerate_range(first, last, out.data());
  }
}

void ConsistentDynamics::velocity_gradients(std::span<Mat2> out) {
  fill_image_velocities();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < model_.particles.size(); ++a)
    out[a] = deformation_rate(a) * inverse(deformation_[a]);
}

void ConsistentDynamics::strain(double dt) {
  fill_image_velocities();
  double strain = 0, speed = 0;
#pragma omp parallel for schedule(static) reduction(max : strain, speed)
  for (std::size_t a = 0; a < model_.particles.size(); ++a) {
    const Mat2 rate = deformation_rate(a);
    const Mat2 gradient = mid_step_gradient(rate, deformation_[a], dt);
    update_stress(model_, a, gradient, dt);
    deformation_[a] += dt * rate;
    model_.particles.density[a] = reference_density_[a] / deformation_[a].determinant();
    write_record(a, rate, bulk_viscous(a, gradient));
    strain = std::max(strain, (deformation_[a] - Mat2::Identity()).lpNorm<Eigen::Infinity>());
    speed = std::max(speed, velocities_[a].squaredNorm());
  }
  largest_strain_ = strain;
  travel_ += dt * std::sqrt(speed);
}

}  // namespace porosph
