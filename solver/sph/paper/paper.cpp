#include "solver/sph/paper/paper.hpp"

#include <cmath>
#include <stdexcept>

#include "solver/space/parallel.hpp"
#include "solver/sph/correction/kernel_correction.hpp"
#include "solver/sph/paper/paper_form.hpp"

namespace porosph {
namespace {

/// Neighbours are searched this much beyond the kernel's support [m].
double skin(const Model& model) { return 0.2 * model.spacing; }

/// The pair's stress R acting along a gradient.
Vec2 along(const Eigen::Vector3d& r, const Vec2& g) {
  return {r[0] * g.x() + r[2] * g.y(), r[2] * g.x() + r[1] * g.y()};
}

}  // namespace

void PaperSums::make_room() {
  const std::size_t n = searched.size();
  for (auto& l : correction) l.resize(n);
  gradient.resize(n);
  for (auto& s : sum) s.resize(n);
  weights.resize(static_cast<std::size_t>(lists.weights / PairLists::widest));
}

void PaperSums::connect(PaperArrays& c) {
  c.lists = &lists;
  for (int k = 0; k < 4; ++k) c.correction[k] = correction[k].data();
  c.weight = reinterpret_cast<double*>(weights.data());
  for (int k = 0; k < PaperArrays::sums; ++k) c.sum[k] = sum[k].data();
}

Mat2 PaperSums::correction_of(std::size_t a) const {
  return (Mat2() << correction[0][a], correction[1][a], correction[2][a], correction[3][a]).finished();
}

Vec2 PaperSums::corrected(std::size_t a, int x, int y) const {
  return correction_of(a) * Vec2(sum[x][a], sum[y][a]);
}

PaperDynamics::PaperDynamics(const FormulationCase& formulation, Model& model, VectorUnits units)
    : model_(model),
      formulation_(formulation),
      viscosity_{formulation.artificial_viscosity_alpha, formulation.artificial_viscosity_beta},
      kernel_(model.smoothing_length),
      kernels_(paper_kernels(units)),
      soils_(model),
      walls_(model, reach()),
      tension_(model, formulation.artificial_stress) {
  if (!model.visibility.ghosts_everywhere())
    throw std::runtime_error(
        "formulation.motion: the paper's forms do not know what to do with thin plates and corners "
        "of walls that are not right angles inwards; use \"consistent\", or a finer particles.spacing");
}

double PaperDynamics::reach() const { return kernel_.support() + skin(model_); }

void PaperDynamics::prepare() {
  const auto& position = model_.particles.position;
  const auto& searched = sums_.searched;
  const double moved =
      largest_of(searched.size(), [&](std::size_t a) { return (position[a] - searched[a]).squaredNorm(); });
  const double slack = skin(model_);
  if (searched.empty() || !(moved < 0.25 * slack * slack)) search();
  points_.take_positions(model_.particles);
  make_gradients();
}

void PaperDynamics::search() {
  const auto& position = model_.particles.position;
  const std::size_t n = position.size();
  sums_.searched = position;
  points_.find_ghosts(model_, walls_.count(), reach());
  sums_.neighbours = find_neighbours(points_.places(), n, reach());
  if (!model_.visibility.everywhere())
    sums_.neighbours = kept(sums_.neighbours, [&](std::int32_t a, std::int32_t b) {
      return b >= static_cast<std::int32_t>(n) || model_.visibility.sees(a, b, model_.particles);
    });
  walls_.search(position, reach());
  sums_.lists = make_pair_lists(sums_.neighbours);
  sums_.make_room();
  connect_arrays();
  stop_.clear();
  for (std::size_t a = 0; a < n; ++a)
    if (model_.soils[model_.particles.soil[a]].flows())
      stop_.watch(static_cast<std::int32_t>(a), 0.25 * model_.spacing);
  ++counts.searches;
}

void PaperDynamics::connect_arrays() {
  PaperArrays& c = arrays_;
  c.smoothing_length = kernel_.h;
  c.slope = kernel_.alpha / (kernel_.h * kernel_.h);
  c.viscosity = {viscosity_.alpha, viscosity_.beta};
  c.rho_squared = PaperForm(formulation_.motion).stress_over_rho_squared;
  for (int k = 0; k < 2; ++k) c.wall_velocity[k] = walls_.velocity(k);
  points_.connect(c.points);
  sums_.connect(c);
}

void PaperDynamics::make_gradients() {
  points_.take_volumes(model_);
  const PairLists& lists = sums_.lists;
#pragma omp parallel for schedule(static)
  for (std::int32_t stretch = 0; stretch < lists.count(); ++stretch) {
    kernels_.geometry(arrays_, stretch);
    for (std::int32_t a = lists.stretches[stretch].first; a < lists.stretches[stretch].last; ++a) correct(a);
  }
  ++counts.refreshes;
}

/// L of eq. (10) and the sums of the corrected gradients.
void PaperDynamics::correct(std::size_t a) {
  const auto& sum = sums_.sum;
  const double xy = sum[PaperArrays::moment_xy][a];
  Mat2 moment = (Mat2() << sum[PaperArrays::moment_xx][a], xy, xy, sum[PaperArrays::moment_yy][a]).finished();
  const Vec2& place = points_.places()[a];
  const bool at_wall = walls_.near(a);
  if (at_wall) moment += walls_.make_gradients(a, place);
  const Mat2 l = formulation_.kernel_correction ? correction_matrix(moment) : Mat2(Mat2::Identity());
  auto& correction = sums_.correction;
  correction[0][a] = l(0, 0), correction[1][a] = l(0, 1);
  correction[2][a] = l(1, 0), correction[3][a] = l(1, 1);
  sums_.gradient[a] = sums_.corrected(a, PaperArrays::gradient_x, PaperArrays::gradient_y);
  if (at_wall) walls_.correct(a, place, l);
}

/// The sums of eqs. (17), (24) and (25) without C_ab.
Vec2 PaperDynamics::stress_and_pressure(std::size_t a) const {
  using Sums = PaperArrays;
  const PaperForm form(formulation_.motion);
  const Particles& p = model_.particles;
  const double rho = p.density[a];
  const Mat2 stress = p.stress[a].in_plane();
  const FixedWalls::Sums& walls = walls_.sums(a);
  const Vec2& gradient = sums_.gradient[a];
  const Vec2 of_xx = sums_.corrected(a, Sums::xx_x, Sums::xx_y),
             of_xy = sums_.corrected(a, Sums::xy_x, Sums::xy_y),
             of_yy = sums_.corrected(a, Sums::yy_x, Sums::yy_y);
  const Vec2 others(of_xx.x() + of_xy.y(), of_xy.x() + of_yy.y());
  const Vec2 all = gradient + walls.gradient;
  const Vec2 pressure = walls.pressure + form.own_pressure * p.pore_pressure[a] * all;

  if (!form.stress_over_rho_squared)
    return (others + stress * (gradient + 2 * walls.gradient) + pressure) / rho;
  const Vec2 of_pressure = sums_.corrected(a, Sums::pressure_x, Sums::pressure_y),
             of_density = sums_.corrected(a, Sums::density_x, Sums::density_y);
  return others + stress * of_density / (rho * rho) +
         (2 * stress * walls.gradient + of_pressure + pressure) / rho;
}

/// sum_b m_b C_ab grad W_ab over particles and ghosts: artificial viscosity.
Vec2 PaperDynamics::viscous(std::size_t a) const {
  return -sums_.corrected(a, PaperArrays::viscous_x, PaperArrays::viscous_y);
}

/// The same: artificial stress.
Vec2 PaperDynamics::tension_control(std::size_t a) const {
  const Mat2 correction = sums_.correction_of(a);
  Vec2 force = Vec2::Zero();
  for (const std::int32_t b : sums_.neighbours.of(a)) {
    const Eigen::Vector3d r = tension_.of(a) + tension_.of(b);
    if (r.isZero(0)) continue;
    const Vec2 to_b = points_.places()[b] - points_.places()[a];
    const double distance = to_b.norm();
    const Vec2 g = -points_.volume(b) * kernel_.slope(distance) * (correction * to_b);
    force += points_.density(b) * tension_.factor(distance) * along(r, g);
  }
  return force;
}

/// The same over virtual particles, which have the density, the stress and the soil of particle a.
Vec2 PaperDynamics::stabilisation_at_walls(std::size_t a) const {
  const Particles& p = model_.particles;
  const double rho = p.density[a];
  Vec2 force = Vec2::Zero();
  walls_.for_neighbours(a, [&](const Vec2& place, const Vec2& g, double stickiness) {
    const Vec2 x = points_.places()[a] - place, v = stickiness * p.velocity[a];
    force -= rho * viscosity_.pair(v.dot(x), x.squaredNorm(), kernel_.h, points_.sound(a), rho) * g;
    if (tension_.active()) force += rho * tension_.factor(x.norm()) * along(2 * tension_.of(a), g);
  });
  return force;
}

void PaperDynamics::accelerations(std::span<Vec2> out) {
  points_.take_velocities(model_.particles);
  points_.take_stress(model_, arrays_.rho_squared);
  tension_.take_stress(model_.particles, points_.ghosts());
  const bool stabilised = viscosity_.active() || tension_.active();
  const PairLists& lists = sums_.lists;
#pragma omp parallel for schedule(static)
  for (std::int32_t stretch = 0; stretch < lists.count(); ++stretch) {
    kernels_.forces(arrays_, stretch);
    for (std::int32_t a = lists.stretches[stretch].first; a < lists.stretches[stretch].last; ++a) {
      out[a] = stress_and_pressure(a) + model_.gravity;
      if (viscosity_.active()) out[a] += viscous(a);
      if (tension_.active()) out[a] += tension_control(a);
      if (stabilised) out[a] += stabilisation_at_walls(a);
    }
  }
  stop_.apply(model_, out);
}

void PaperDynamics::velocity_gradients(std::span<Mat2> out) {
  using Sums = PaperArrays;
  points_.take_velocities(model_.particles);
  const auto& sum = sums_.sum;
  const PairLists& lists = sums_.lists;
#pragma omp parallel for schedule(static)
  for (std::int32_t stretch = 0; stretch < lists.count(); ++stretch) {
    kernels_.rates(arrays_, stretch);
    for (std::int32_t a = lists.stretches[stretch].first; a < lists.stretches[stretch].last; ++a)
      out[a] << sum[Sums::rate_xx][a], sum[Sums::rate_xy][a], sum[Sums::rate_yx][a], sum[Sums::rate_yy][a];
  }
}

void PaperDynamics::strain(double dt) {
  stop_.stepped(dt);
  points_.take_velocities(model_.particles);
  arrays_.soil = {soils_.view(), &model_.particles.stress.data()->xx, model_.particles.density.data()};
#pragma omp parallel for schedule(static)
  for (std::int32_t stretch = 0; stretch < sums_.lists.count(); ++stretch)
    kernels_.strain(arrays_, stretch, dt);
}

/// Neighbours and ghosts are those of the last search; the rest is rebuilt in every step.
void PaperDynamics::visit(StateArchive& state) {
  bool has_searched = !sums_.searched.empty();
  state.value("has_searched", has_searched);
  stop_.visit(state);
  if (!has_searched) return;
  std::vector<Vec2> then = sums_.searched;
  then.resize(model_.particles.size());
  state.array("searched", then);
  if (!state.restoring()) return;
  model_.particles.position.swap(then);
  search();
  model_.particles.position.swap(then);
}

}  // namespace porosph
