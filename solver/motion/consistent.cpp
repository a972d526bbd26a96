#include "solver/motion/consistent.hpp"

#include <algorithm>
#include <cmath>

#include "solver/correction/kernel_correction.hpp"
#include "solver/motion/material_block.hpp"
#include "solver/parallel.hpp"

namespace porosph {
namespace {

enum : int { t_xx, t_yx, t_xy, t_yy, pressure, v_x, v_y };  // lanes of a record

Mat2 stress_lanes(const Record& r) {
  return (Mat2() << r.q[t_xx], r.q[t_xy], r.q[t_yx], r.q[t_yy]).finished();
}

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

/// rho c_p for the zero-energy viscosity: of the lightest soil, whose particles it could otherwise push too far
/// in a step, and of the fastest wave, which sets the step.
double controlled_rho_c(const Model& model) {
  const auto& density = model.particles.density;
  return *std::min_element(density.begin(), density.end()) * model.wave_speed;
}

}  // namespace

ConsistentDynamics::ConsistentDynamics(const FormulationCase& formulation, Model& model)
    : model_(model),
      formulation_(formulation),
      kernel_(model.smoothing_length),
      zero_energy_viscosity_(formulation.zero_energy_control * controlled_rho_c(model) *
                             model.smoothing_length) {}

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

/// Gradients at the particles next to bearing walls that see only the soil (and its mirror images at other
/// walls), to carry the stress on linearly behind the wall.
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
  strain_all(0);
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
  return velocity_sum(neighbours_, gradient_.data(), velocities_.data(), gradient_sum_[a], a) *
         correction_[a].transpose();
}

/// Stress, deformation and records of particles first to last - 1 after a step dt with the present
/// velocities. Returns the largest |F - I| and the largest speed squared among them.
ConsistentDynamics::Largest ConsistentDynamics::strain_block(std::size_t first, std::size_t last, double dt) {
  Particles& p = model_.particles;
  MaterialBlock block;
  for (std::size_t i = 0; i < last - first; ++i) {
    const std::size_t a = first + i;
    const Mat2 rate = deformation_rate(a);
    const LinearElastic& soil = model_.soils[p.soil[a]];
    const Stress& s = p.stress[a];
    const Mat2& f = deformation_[a];
    block.rate[0][i] = rate(0, 0), block.rate[1][i] = rate(0, 1);
    block.rate[2][i] = rate(1, 0), block.rate[3][i] = rate(1, 1);
    block.deformation[0][i] = f(0, 0), block.deformation[1][i] = f(0, 1);
    block.deformation[2][i] = f(1, 0), block.deformation[3][i] = f(1, 1);
    block.stress[0][i] = s.xx, block.stress[1][i] = s.yy, block.stress[2][i] = s.zz,
    block.stress[3][i] = s.xy;
    block.shear_modulus[i] = soil.shear_modulus, block.bulk_modulus[i] = soil.bulk_modulus;
    block.no_tension[i] = soil.no_tension ? 1.0 : 0.0;
    block.reference_density[i] = reference_density_[a];
  }
  block.advance(dt, formulation_.bulk_viscosity * model_.smoothing_length);
  Largest largest;
  for (std::size_t i = 0; i < last - first; ++i) {
    const std::size_t a = first + i;
    const double mu = zero_energy_viscosity_;
    Mat2& f = deformation_[a];
    f << block.deformation[0][i], block.deformation[1][i], block.deformation[2][i], block.deformation[3][i];
    p.stress[a] = {block.stress[0][i], block.stress[1][i], block.stress[2][i], block.stress[3][i]};
    p.density[a] = block.density[i];
    Mat2& piola = piola_[a];
    piola << block.piola[0][i], block.piola[1][i], block.piola[2][i], block.piola[3][i];
    const Mat2& l = correction_[a];
    Lanes& q = records_[a].q;
    q[t_xx] = piola(0, 0) * l(0, 0) + piola(0, 1) * l(1, 0) - mu * block.rate[0][i];
    q[t_xy] = piola(0, 0) * l(0, 1) + piola(0, 1) * l(1, 1) - mu * block.rate[1][i];
    q[t_yx] = piola(1, 0) * l(0, 0) + piola(1, 1) * l(1, 0) - mu * block.rate[2][i];
    q[t_yy] = piola(1, 0) * l(0, 1) + piola(1, 1) * l(1, 1) - mu * block.rate[3][i];
    q[v_x] = velocities_[a].x(), q[v_y] = velocities_[a].y();
    largest.strain = std::max(
        {largest.strain, std::abs(f(0, 0) - 1), std::abs(f(0, 1)), std::abs(f(1, 0)), std::abs(f(1, 1) - 1)});
    largest.speed_squared = std::max(largest.speed_squared, velocities_[a].squaredNorm());
  }
  return largest;
}

/// Carries all particles over a step dt with the velocities of velocities_; dt = 0 only writes the records.
ConsistentDynamics::Largest ConsistentDynamics::strain_all(double dt) {
  const auto blocks =
      static_cast<std::int64_t>((model_.particles.size() + MaterialBlock::size - 1) / MaterialBlock::size);
  double strain = 0, speed_squared = 0;
#pragma omp parallel for schedule(static) reduction(max : strain, speed_squared)
  for (std::int64_t block = 0; block < blocks; ++block) {
    const std::size_t first = static_cast<std::size_t>(block) * MaterialBlock::size;
    const Largest l = strain_block(first, std::min(first + MaterialBlock::size, model_.particles.size()), dt);
    strain = std::max(strain, l.strain);
    speed_squared = std::max(speed_squared, l.speed_squared);
  }
  return {strain, speed_squared};
}

void ConsistentDynamics::fill_image_velocities() {
  const auto& v = model_.particles.velocity;
  std::copy(v.begin(), v.end(), velocities_.begin());
  for (std::size_t i = 0; i < images_.size(); ++i)
    velocities_[v.size() + i] =
        image_of_velocity(model_.walls[images_[i].wall], velocities_[images_[i].parent]);
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
      stress = across * stress * across + along * stress * along + across * mirrored * along +
               along * mirrored * across;
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
    set_stress_lanes(
        record, piola_[n + i] * correction_[n + i] + image_of_rate(model_.walls[images_[i].wall], viscous));
    record.q[v_x] = velocities_[n + i].x();
    record.q[v_y] = velocities_[n + i].y();
  }
}

void ConsistentDynamics::accelerate_range(std::size_t first, std::size_t last, Vec2* out) const {
  const Record* records = records_.data();
  const std::int64_t* begin = neighbours_.begin.data();
  const std::int32_t* index = neighbours_.index.data();
  const PairGradient* gradient = gradient_.data();
  const double* weight = weight_.data();
  const double mu = zero_energy_viscosity_;
  for (std::size_t a = first; a < last; ++a) {
    Lanes x{}, y{}, w{}, x2{}, y2{}, w2{};  // two sums of each: an addition need not wait for the one before
    std::int64_t k = begin[a];
    for (; k + 1 < begin[a + 1]; k += 2) {
      const Lanes q = records[index[k]].q, q2 = records[index[k + 1]].q;
      x += q * gradient[k].x, x2 += q2 * gradient[k + 1].x;
      y += q * gradient[k].y, y2 += q2 * gradient[k + 1].y;
      w += q * weight[k], w2 += q2 * weight[k + 1];
    }
    if (k < begin[a + 1]) {
      const Lanes q = records[index[k]].q;
      x += q * gradient[k].x, y += q * gradient[k].y, w += q * weight[k];
    }
    x += x2, y += y2, w += w2;
    const Lanes own = records[a].q;
    const Vec2& s = gradient_sum_[a];
    const Vec2 stress_force(x[t_xx] + y[t_xy] + own[t_xx] * s.x() + own[t_xy] * s.y(),
                            x[t_yx] + y[t_yy] + own[t_yx] * s.x() + own[t_yy] * s.y());
    const Vec2 viscous_force =
        2 * mu * Vec2(w[v_x] - own[v_x] * weight_sum_[a], w[v_y] - own[v_y] * weight_sum_[a]);
    const Vec2 pressure_sum(x[pressure] - own[pressure] * s.x(),
                            y[pressure] - own[pressure] * s.y());  // eq. (22)
    const Mat2& f = deformation_[a];
    const Vec2 corrected = correction_[a] * pressure_sum;
    const Vec2 pressure_force(
        f(1, 1) * corrected.x() - f(1, 0) * corrected.y(),  // J F^-T, the cofactors of F
        f(0, 0) * corrected.y() - f(0, 1) * corrected.x());
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
  const Largest largest = strain_all(dt);
  largest_strain_ = largest.strain;
  travel_ += dt * std::sqrt(largest.speed_squared);
}

}  // namespace porosph
