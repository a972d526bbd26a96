#include "app/bench/plain_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/sph/correction/kernel_correction.hpp"

namespace porosph::bench {
namespace {

/// Velocity gradient over the coordinates at the middle of the step, from `rate`, that over those at its
/// start [1/s] (Hughes and Winget 1980: a rigid rotation strains nothing).
Mat2 mid_step_gradient(const Mat2& rate, double dt) {
  return rate * inverse(Mat2(Mat2::Identity() + 0.5 * dt * rate));
}

/// Effective stress (eq. 30) and density, d(rho)/dt = -rho tr(D), after a step dt [s].
void update_soil(Model& model, std::size_t a, const Mat2& gradient, double dt) {
  Particles& p = model.particles;
  LinearElastic::History none;
  p.stress[a] =
      std::get<LinearElastic>(model.soils[p.soil[a]].law()).step(p.stress[a], Gradient(gradient), dt, none);
  const double half = 0.5 * dt * gradient.trace();
  p.density[a] *= (1 - half) / (1 + half);
}

}  // namespace

PlainDynamics::PlainDynamics(const FormulationCase& formulation, Model& model)
    : model_(model),
      corrected_(formulation.kernel_correction),
      viscosity_{formulation.artificial_viscosity_alpha, formulation.artificial_viscosity_beta},
      kernel_(model.smoothing_length),
      skin_(0.2 * model.spacing) {
  if (formulation.motion != Motion::proposed || formulation.artificial_stress != 0)
    throw std::invalid_argument("the plain loops know the proposed form without artificial stress only");
  make_virtual_particles();
}

/// Rows of images of the soil as it lies at first, in the fixed walls and from there in the rollers.
void PlainDynamics::make_virtual_particles() {
  const auto& walls = model_.walls;
  const Particles& p = model_.particles;
  fixed_walls_ =
      std::count_if(walls.begin(), walls.end(), [](const Wall& w) { return w.support().carries_shear(); });
  std::vector<Vec2> places = p.position;
  std::vector<Image> images;
  append_images(walls, 0, fixed_walls_, kernel_.support() + skin_, places, images);
  const std::size_t in_fixed = images.size();
  std::vector<Vec2> behind(places.begin() + static_cast<std::ptrdiff_t>(p.size()), places.end());
  std::vector<Image> at_corners;
  append_images(walls, fixed_walls_, walls.size(), kernel_.support() + skin_, behind, at_corners);
  for (const Image& i : at_corners)
    images.push_back({i.parent + static_cast<std::int32_t>(p.size()), i.wall});

  const std::vector<std::int32_t> root = roots(images, p.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    Point b;
    b.x = behind[i];
    b.volume = p.volume(root[i]);
    b.pressure = model_.water.pore_pressure(p.position[root[i]].x(), b.x.y());
    virtuals_.push_back(b);
    virtual_wall_.push_back(i < in_fixed ? images[i].wall : virtual_wall_[images[i].parent - p.size()]);
  }
}

void PlainDynamics::prepare() {
  const auto& position = model_.particles.position;
  double moved = searched_.empty() ? never : 0;
  for (std::size_t a = 0; a < searched_.size(); ++a)
    moved = std::max(moved, (position[a] - searched_[a]).norm());
  if (!(moved < skin_ / 2)) search();
  fill_points();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < position.size(); ++a) correction_[a] = correction(a);
  ++counts.refreshes;
}

void PlainDynamics::search() {
  const Particles& p = model_.particles;
  const double reach = kernel_.support() + skin_;
  std::vector<Vec2> places = p.position;
  ghosts_.clear();
  append_images(model_.walls, fixed_walls_, model_.walls.size(), reach, places, ghosts_);
  ghost_root_ = roots(ghosts_, p.size());
  first_virtual_ = places.size();
  for (const Point& b : virtuals_) places.push_back(b.x);
  neighbours_ = find_neighbours(places, p.size(), reach);
  points_.resize(first_virtual_);
  points_.insert(points_.end(), virtuals_.begin(), virtuals_.end());
  correction_.resize(p.size());
  searched_ = p.position;
  ++counts.searches;
}

void PlainDynamics::fill_points() {
  const Particles& p = model_.particles;
  for (std::size_t a = 0; a < p.size(); ++a)
    points_[a] = {.x = p.position[a],
                  .v = p.velocity[a],
                  .stress = p.stress[a].in_plane(),
                  .pressure = p.pore_pressure[a],
                  .density = p.density[a],
                  .volume = p.volume(a),
                  .sound = std::sqrt(model_.soils[p.soil[a]].shear_modulus() / p.density[a])};  // eq. (16)
  for (std::size_t i = 0; i < ghosts_.size(); ++i) points_[p.size() + i] = mirrored(i);
}

PlainDynamics::Point PlainDynamics::mirrored(std::size_t ghost) const {
  const Wall& wall = model_.walls[ghosts_[ghost].wall];
  const Mat2 r = wall.reflection();
  Point b = points_[ghosts_[ghost].parent];
  b.x = wall.mirrored(b.x);
  b.v = r * b.v;
  b.stress = r * b.stress * r;
  b.pressure = model_.water.pore_pressure(model_.particles.position[ghost_root_[ghost]].x(), b.x.y());
  return b;
}

void PlainDynamics::fill_velocities() {
  const auto& v = model_.particles.velocity;
  for (std::size_t a = 0; a < v.size(); ++a) points_[a].v = v[a];
  for (std::size_t i = 0; i < ghosts_.size(); ++i)
    points_[v.size() + i].v = model_.walls[ghosts_[i].wall].reflection() * points_[ghosts_[i].parent].v;
}

/// As particle a sees it: of its own stress, density and soil, and sticking to the wall.
PlainDynamics::Point PlainDynamics::virtual_particle(std::size_t b, std::size_t seen_by) const {
  const Wall& wall = model_.walls[virtual_wall_[b - first_virtual_]];
  const Point &a = points_[seen_by], &here = points_[b];
  const double mine = wall.distance(a.x), its = -wall.distance(here.x);
  Point seen = a;
  seen.x = here.x;
  seen.v = -(its < 0.5 * mine ? its / mine : 0.5) * a.v;
  seen.pressure = here.pressure;
  seen.volume = here.volume;
  return seen;
}

/// Calls use(b, V_b grad_a W_ab) for the neighbours b of particle a.
template <class Use>
void PlainDynamics::for_neighbours(std::size_t a, Use use) const {
  for (const std::int32_t index : neighbours_.of(a)) {
    const auto b = static_cast<std::size_t>(index);
    const Vec2 apart = points_[a].x - points_[b].x;
    const Vec2 gradient = points_[b].volume * kernel_.slope(apart.norm()) * apart;
    if (b < first_virtual_)
      use(points_[b], gradient);
    else
      use(virtual_particle(b, a), gradient);
  }
}

/// L of eq. (10).
Mat2 PlainDynamics::correction(std::size_t a) const {
  if (!corrected_) return Mat2::Identity();
  Mat2 sum = Mat2::Zero();
  for_neighbours(
      a, [&](const Point& b, const Vec2& gradient) { sum += gradient * (b.x - points_[a].x).transpose(); });
  return correction_matrix(sum);
}

/// Eq. (24) with artificial viscosity.
Vec2 PlainDynamics::acceleration(std::size_t index) const {
  const Point& a = points_[index];
  const double h = kernel_.h;
  Vec2 sum = model_.gravity;
  for_neighbours(index, [&](const Point& b, const Vec2& gradient) {
    const Vec2 g = correction_[index] * gradient;
    const Vec2 apart = a.x - b.x;
    const double viscosity = viscosity_.pair((a.v - b.v).dot(apart), apart.squaredNorm(), h,
                                             0.5 * (a.sound + b.sound), 0.5 * (a.density + b.density));
    sum +=
        ((a.stress + b.stress) * g + (b.pressure - a.pressure) * g) / a.density - b.density * viscosity * g;
  });
  return sum;
}

void PlainDynamics::accelerations(std::span<Vec2> out) {
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < out.size(); ++a) out[a] = acceleration(a);
}

/// Of which eqs. (29) and (31) are the symmetric and the skew part.
Mat2 PlainDynamics::velocity_gradient(std::size_t a) const {
  Mat2 sum = Mat2::Zero();
  for_neighbours(a, [&](const Point& b, const Vec2& gradient) {
    sum += (b.v - points_[a].v) * (correction_[a] * gradient).transpose();
  });
  return sum;
}

void PlainDynamics::velocity_gradients(std::span<Mat2> out) {
  fill_velocities();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < out.size(); ++a) out[a] = velocity_gradient(a);
}

void PlainDynamics::strain(double dt, std::span<const double>) {
  fill_velocities();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < model_.particles.size(); ++a) {
    update_soil(model_, a, mid_step_gradient(velocity_gradient(a), dt), dt);
  }
}

void PlainDynamics::visit(StateArchive&) { throw std::logic_error("the plain loops keep no checkpoints"); }

}  // namespace porosph::bench
