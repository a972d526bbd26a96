#include "solver/motion/consistent.hpp"

#include <algorithm>
#include <cmath>

#include "solver/correction/kernel_correction.hpp"
#include "solver/motion/closed_gradients.hpp"
#include "solver/neighbours/neighbour_list.hpp"

namespace porosph {
namespace {

Mat2 matrix(const PlaneTensor& t) { return (Mat2() << t[0], t[1], t[2], t[3]).finished(); }
PlaneTensor plane_tensor(const Mat2& m) { return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)}; }

void resize(PlaneTensors& t, std::size_t size) {
  for (auto& component : t) component.resize(size);
}

/// rho c_p for the zero-energy viscosity: of the lightest soil, whose particles it could otherwise push too
/// far in a step, and of the fastest wave, which sets the step.
double controlled_rho_c(const Model& model) {
  const auto& density = model.particles.density;
  return *std::min_element(density.begin(), density.end()) * model.wave_speed;
}

}  // namespace

ConsistentDynamics::ConsistentDynamics(const FormulationCase& formulation, Model& model, VectorUnits units)
    : model_(model),
      formulation_(formulation),
      kernel_(model.smoothing_length),
      kernels_(consistent_kernels(units)),
      soil_(model),
      zero_energy_viscosity_(formulation.zero_energy_control * controlled_rho_c(model) *
                             model.smoothing_length) {
  for (const Wall& wall : model.walls) {
    const Mat2 r = wall.reflection();
    reflection_.push_back({r, wall.kind == BoundaryKind::fixed ? Mat2(-Mat2::Identity()) : r});
  }
}

void ConsistentDynamics::prepare() {
  const bool close = travel_ > 0.05 * model_.spacing && strangers_are_near();
  const bool due = !have_reference_ || largest_strain_ > formulation_.refresh_strain || close;
  if (due) refresh();
}

void ConsistentDynamics::refresh() {
  make_reference();
  start_from_reference();
  have_reference_ = true;
  ++counts.refreshes;
}

/// Everything that belongs to the reference configuration, for the particles where they are now.
void ConsistentDynamics::make_reference() {
  make_images();
  make_gradients();
  make_corrections();
  close();
  set_zero_energy_rate();
  make_one_sided_gradients();
  choose_records();
  make_room();
  connect_arrays();
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
  images_of_images_.clear();
  for (std::size_t i = 0; i < images_.size(); ++i)
    if (images_[i].parent >= static_cast<std::int32_t>(model_.particles.size()))
      images_of_images_.push_back(i);
}

void ConsistentDynamics::make_gradients() {
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
  volume_.resize(points_.size());
  reference_density_ = p.density;
  for (std::size_t a = 0; a < n; ++a) volume_[a] = p.volume(a) / p.fill[a];
  for (std::size_t i = 0; i < images_.size(); ++i) volume_[n + i] = volume_[images_[i].parent];
  stencils_ = make_pair_stencils(points_, n, volume_, kernel_, formulation_.single_precision);
  ++counts.searches;
}

/// L of eq. (10).
void ConsistentDynamics::make_corrections() {
  const std::size_t n = model_.particles.size();
  resize(correction_, points_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    Mat2 sum = Mat2::Zero();
    stencils_.for_neighbours(static_cast<std::int32_t>(a), [&](std::int32_t b, const PairGeometry& g) {
      sum += Vec2(g.x, g.y) * (points_[b] - points_[a]).transpose();
    });
    set(correction_, a, formulation_.kernel_correction ? correction_matrix(sum) : Mat2(Mat2::Identity()));
  }
}

/// Then the images' L: their parents', mirrored.
void ConsistentDynamics::close() {
  const std::size_t n = model_.particles.size();
  kappa_.clear();
  if (formulation_.closed_gradients && formulation_.kernel_correction) {
    std::vector<Mat2> corrections(n), reflections;
    for (std::size_t a = 0; a < n; ++a) corrections[a] = correction(a);
    for (const Reflection& r : reflection_) reflections.push_back(r.stress);
    Closure closure = close_gradients({.stencils = stencils_,
                                       .volumes = volume_,
                                       .fill = model_.particles.fill,
                                       .correction = corrections,
                                       .images = images_,
                                       .reflections = reflections,
                                       .spacing = model_.spacing});
    kappa_ = std::move(closure.kappa);
    counts.closures += kappa_.empty() ? 0 : 1;
    for (std::size_t a = 0; a < closure.correction.size(); ++a) set(correction_, a, closure.correction[a]);
  }
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const Mat2& r = reflection_[images_[i].wall].stress;
    set(correction_, n + i, r * correction(images_[i].parent) * r);
  }
}

/// Closed gradients leave non-linear motion softer springs than a lattice's, and the imbalance of single
/// particles works on it.
void ConsistentDynamics::set_zero_energy_rate() {
  constexpr double in_disorder = 0.1;  // by the map cases/stability/disorder.toml
  double stiffness = formulation_.zero_energy_stiffness;
  if (stiffness < 0) stiffness = kappa_.empty() ? 0 : in_disorder;
  zero_energy_rate_ = stiffness * model_.wave_speed / model_.smoothing_length;
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
    stencils_.for_neighbours(a, [&](std::int32_t b, const PairGeometry& pair) {
      if (b >= static_cast<std::int32_t>(n) && stems_from_extrapolated[b - n]) return;
      const Vec2 g(pair.x, pair.y);
      stencil.neighbours.push_back(b);
      stencil.gradient.push_back(g);
      sum += g * (points_[b] - points_[a]).transpose();
    });
    const Mat2 correction = correction_matrix(sum, 0.01);  // it extrapolates, no force is as stiff as it
    for (Vec2& g : stencil.gradient) g = correction * g;
    place[a] = one_sided_of_[i] = static_cast<std::int32_t>(one_sided_.size());
    one_sided_.push_back(std::move(stencil));
  }
}

/// Marks the particles whose values are asked for one by one, beside the arrays.
void ConsistentDynamics::choose_records() {
  const std::size_t n = model_.particles.size();
  listed_.assign(points_.size(), 0);
  for (const std::int32_t b : stencils_.index) listed_[b] = 1;
  mirrored_.assign(n, kappa_.empty() ? 0 : 1);
  const auto mirror = [&](std::int32_t b) {
    if (b < static_cast<std::int32_t>(n)) mirrored_[b] = 1;
  };
  for (const Image& image : images_) mirror(image.parent);
  for (const OneSided& stencil : one_sided_) {
    mirror(stencil.particle);
    for (const std::int32_t b : stencil.neighbours) mirror(b);
  }
}

void ConsistentDynamics::start_from_reference() {
  update_velocities();
  strain_all(0);
  largest_strain_ = 0;
  travel_ = 0;
}

/// For the state since the reference: undeformed so far.
void ConsistentDynamics::make_room() {
  const Particles& p = model_.particles;
  for (int k = 0; k < 4; ++k) deformation_[k].assign(p.size(), k == 0 || k == 3 ? 1.0 : 0.0);
  resize(flux_, points_.size());
  for (auto& v : velocity_) v.resize(points_.size());
  wet_ = model_.water.present() ||
         std::any_of(p.pore_pressure.begin(), p.pore_pressure.end(), [](double w) { return w != 0; });
  if (wet_) pressure_.resize(points_.size());
  if (zero_energy_rate_ != 0)
    for (auto& m : motion_) m.resize(points_.size());
  records_.assign(points_.size(), Record{});
  piola_.assign(points_.size(), PlaneTensor{});
  image_positions_.resize(images_.size());
  stress_gradient_.resize(one_sided_.size());
}

void ConsistentDynamics::connect_arrays() {
  Particles& p = model_.particles;
  const auto const_data = [](const PlaneTensors& t, const double** out) {
    for (int k = 0; k < 4; ++k) out[k] = t[k].data();
  };
  const auto data = [](PlaneTensors& t, double** out) {
    for (int k = 0; k < 4; ++k) out[k] = t[k].data();
  };
  ConsistentArrays& c = arrays_;
  c.stencils = &stencils_;
  const_data(correction_, c.correction);
  c.kappa = kappa_.empty() ? nullptr : kappa_.data()->data();
  c.reference_density = reference_density_.data();
  c.shear_modulus = soil_.shear_modulus.data(), c.bulk_modulus = soil_.bulk_modulus.data();
  c.no_tension = soil_.no_tension.data();
  c.one_soil = model_.soils.size() == 1;
  c.wet = wet_;
  c.zero_energy_viscosity = zero_energy_viscosity_;
  c.zero_energy_rate = zero_energy_rate_;
  c.fill = p.fill.data();
  const auto& motion = zero_energy_rate_ != 0 ? motion_ : velocity_;
  c.motion[0] = motion[0].data(), c.motion[1] = motion[1].data();
  c.bulk_length = formulation_.bulk_viscosity * model_.smoothing_length;
  c.gravity[0] = model_.gravity.x(), c.gravity[1] = model_.gravity.y();
  data(deformation_, c.deformation);
  c.stress = &p.stress.data()->xx;
  c.density = p.density.data();
  data(flux_, c.flux);
  c.pressure = pressure_.data();
  c.velocity[0] = velocity_[0].data(), c.velocity[1] = velocity_[1].data();
  c.listed = listed_.data();
  c.records = records_.data();
  c.mirrored = mirrored_.data();
  c.piola = piola_.data()->data();
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
  for (std::size_t a = 0; a < n; ++a)
    for (const std::int32_t b : now.of(a))
      found = found || !stencils_.are_neighbours(static_cast<std::int32_t>(a), b);
  return found;
}

/// Carries all particles over a step dt with the velocities of velocity_; dt = 0 only writes the fluxes.
LargestChange ConsistentDynamics::strain_all(double dt) {
  double strain = 0, speed_squared = 0;
#pragma omp parallel for schedule(static) reduction(max : strain, speed_squared)
  for (std::int32_t tile = 0; tile < stencils_.tiles(); ++tile) {
    LargestChange largest;
    kernels_.strain(arrays_, tile, dt, largest);
    strain = std::max(strain, largest.strain);
    speed_squared = std::max(speed_squared, largest.speed_squared);
  }
  return {strain, speed_squared};
}

/// Velocities of particles and images, beside each other and in the records.
void ConsistentDynamics::update_velocities() {
  const std::vector<Vec2>& v = model_.particles.velocity;
  spread(velocity_, [&](std::size_t a) { return v[a]; });
}

/// v + rate * displacement, which the zero-energy control acts on. Takes the velocities' place in the records
/// until the next step, when all have been strained.
void ConsistentDynamics::update_motion() {
  if (zero_energy_rate_ == 0) return;
  const Particles& p = model_.particles;
  spread(motion_, [&](std::size_t a) {
    return Vec2(p.velocity[a] + zero_energy_rate_ * (p.position[a] - points_[a]));
  });
}

void ConsistentDynamics::update_pressures() {
  if (!wet_) return;
  const Particles& p = model_.particles;
  const std::size_t n = p.size();
  const auto record = [&](std::size_t i) {
    if (listed_[i]) records_[i].q[pressure_lane] = pressure_[i];
  };
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    pressure_[a] = p.pore_pressure[a];
    record(a);
  }
  for_images(0, [&](std::size_t i) {
    const std::size_t parent = images_[i].parent;
    const Vec2& from = parent < n ? p.position[parent] : image_positions_[parent - n];
    const Vec2 here = image_positions_[i] = model_.walls[images_[i].wall].mirrored(from);
    pressure_[n + i] = model_.water.pore_pressure_behind_wall(p.position[root_[i]], here);
    record(n + i);
  });
}

/// P behind a bearing wall goes on linearly from the soil in front of it; a roller carries no shear.
void ConsistentDynamics::extrapolate_stress() {
  const std::size_t n = model_.particles.size();
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < one_sided_.size(); ++s) {
    const OneSided& stencil = one_sided_[s];
    const Mat2 own = matrix(piola_[stencil.particle]);
    Mat2 along_x = Mat2::Zero(), along_y = Mat2::Zero();
    for (std::size_t k = 0; k < stencil.neighbours.size(); ++k) {
      const Mat2 difference = matrix(piola_[stencil.neighbours[k]]) - own;
      along_x += difference * stencil.gradient[k].x();
      along_y += difference * stencil.gradient[k].y();
    }
    stress_gradient_[s] = {along_x, along_y};
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < extrapolated_; ++i) {
    const auto& [along_x, along_y] = stress_gradient_[one_sided_of_[i]];
    const Wall& wall = model_.walls[images_[i].wall];
    const Mat2 root = matrix(piola_[root_[i]]);
    const Vec2 way = points_[n + i] - points_[root_[i]];
    Mat2 stress = root + along_x * way.x() + along_y * way.y();
    if (wall.kind == BoundaryKind::roller) {
      const Mat2 across = wall.normal * wall.normal.transpose(), along = Mat2::Identity() - across;
      const Mat2& reflection = reflection_[images_[i].wall].stress;
      const Mat2 mirrored = reflection * root * reflection;
      stress = across * stress * across + along * stress * along + across * mirrored * along +
               along * mirrored * across;
    }
    piola_[n + i] = plane_tensor(stress);
  }
}

void ConsistentDynamics::update_image_fluxes() {
  const std::size_t n = model_.particles.size();
  const auto mirror_stress = [&](std::size_t i) {
    const Mat2& r = reflection_[images_[i].wall].stress;
    piola_[n + i] = plane_tensor(r * matrix(piola_[images_[i].parent]) * r);
  };
  for_images(extrapolated_, mirror_stress);
  extrapolate_stress();
  for (const std::size_t i : images_of_images_)
    if (i >= extrapolated_) mirror_stress(i);

  for_images(0, [&](std::size_t i) {
    const auto parent = static_cast<std::size_t>(images_[i].parent);
    const Reflection& wall = reflection_[images_[i].wall];
    const double fill = model_.particles.fill[root_[i]];
    const Mat2 control = get(flux_, parent) - fill * matrix(piola_[parent]) * correction(parent);
    const Mat2 flux =
        fill * matrix(piola_[n + i]) * correction(n + i) + wall.velocity * control * wall.stress;
    set(flux_, n + i, flux);
    if (!listed_[n + i]) return;
    Lanes& q = records_[n + i].q;
    for (int k = 0; k < 4; ++k) q[k] = flux_[k][n + i];
  });
}

void ConsistentDynamics::accelerations(std::span<Vec2> out) {
  update_pressures();
  update_motion();
  update_image_fluxes();
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < stencils_.tiles(); ++tile)
    kernels_.accelerate(arrays_, tile, out.data()->data());
}

void ConsistentDynamics::velocity_gradients(std::span<Mat2> out) {
  update_velocities();
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < stencils_.tiles(); ++tile) {
    std::array<PlaneTensor, PairStencils::tile> rate;
    kernels_.rates(arrays_, tile, rate.data()->data());
    const std::size_t first = static_cast<std::size_t>(tile) * PairStencils::tile;
    for (std::size_t a = first; a < std::min(first + PairStencils::tile, out.size()); ++a)
      out[a] = matrix(rate[a - first]) * inverse(get(deformation_, a));
  }
}

void ConsistentDynamics::visit(StateArchive& state) {
  state.value("has_reference", have_reference_);
  if (!have_reference_) return;
  const std::size_t n = model_.particles.size();
  std::vector<Vec2> positions(n);
  std::vector<double> densities(n);
  if (!state.restoring()) {
    std::copy_n(points_.begin(), n, positions.begin());
    densities = reference_density_;
  }
  state.array("reference_position", positions);
  state.array("reference_density", densities);
  if (state.restoring()) restore_reference(positions, densities);
  for (auto& component : deformation_) state.array("deformation", component);
  for (auto& component : flux_) state.array("flux", std::span(component).first(n));
  state.array("piola",
              std::span(piola_).first(n));  // of the images, as their flux: made when they are needed
  state.value("largest_strain", largest_strain_);
  state.value("travel", travel_);
  if (state.restoring()) update_flux_records();
}

/// The reference as it was made when the particles had these positions and densities.
void ConsistentDynamics::restore_reference(std::vector<Vec2>& positions, std::vector<double>& densities) {
  Particles& p = model_.particles;
  p.position.swap(positions), p.density.swap(densities);
  make_reference();
  p.position.swap(positions), p.density.swap(densities);
  connect_arrays();
  update_velocities();
}

/// As the kernels leave them after each step.
void ConsistentDynamics::update_flux_records() {
  for (std::size_t a = 0; a < model_.particles.size(); ++a)
    if (listed_[a])
      for (int k = 0; k < 4; ++k) records_[a].q[k] = flux_[k][a];
}

void ConsistentDynamics::strain(double dt) {
  update_velocities();
  const LargestChange largest = strain_all(dt);
  largest_strain_ = largest.strain;
  travel_ += dt * std::sqrt(largest.speed_squared);
}

}  // namespace porosph
