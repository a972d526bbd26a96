#include "solver/sph/consistent/fluxes.hpp"

#include <algorithm>

namespace porosph {

Fluxes::Fluxes(const ReferenceConfiguration& r, const Model& model, bool elastic_control,
               const LooseParticles* loose, SparselyWritten<Record> room)
    : records_(std::move(room)),
      behind_walls_(r, std::ranges::any_of(model.soils, &Soil::flows), loose),
      along_interfaces_(r, model) {
  const Particles& p = model.particles;
  const std::size_t all = r.points.size();
  deformation_.assign(p.size(), Mat2::Identity());
  flux_.resize(all);
  for (auto& v : velocity_) v.resize(all);
  const bool wet = model.pore_water->acts(model.water) ||
                   std::ranges::any_of(p.pore_pressure, [](double w) { return w != 0; });
  if (wet) pressure_.resize(all);
  if (elastic_control)
    for (auto& m : controlled_) m.resize(all);
  if (records_.size() < all) SparselyWritten<Record>(all + all / 8).swap(records_);  // ghosts come and go
  mirrored_.assign(p.size(), r.closed() ? 1 : 0);
  behind_walls_.mark_used(r, mirrored_);
  if (along_interfaces_.acts()) keep_piola_of(r.own_sides.particle);
  piola_.resize(all);
  ghost_positions_.resize(r.ghosts.size());
}

Fluxes Fluxes::of_pressures(const ReferenceConfiguration& r) {
  const std::size_t all = r.points.size();
  Fluxes f;
  f.flux_.resize(all), f.piola_.resize(all), f.records_.resize(all);
  for (auto& v : f.velocity_) v.resize(all);  // the loops read them, times 0
  f.mirrored_.assign(r.particles(), 1);
  f.deformation_.assign(r.particles(), Mat2::Identity());
  return f;
}

/// Writes the vector of_particle(a) of each particle, and of their ghosts what moves with it, into `field`
/// and the records' velocity lanes.
template <Mirrors how, class Of>
void Fluxes::spread(const ReferenceConfiguration& r, std::array<std::vector<double>, 2>& field,
                    Of&& of_particle) {
  double *x = field[0].data(), *y = field[1].data();
  const auto write = [&](std::size_t i, const Vec2& v) {
    x[i] = v.x(), y[i] = v.y();
    if (r.listed[i]) records_[i].q[velocity_lane] = v.x(), records_[i].q[velocity_lane + 1] = v.y();
  };
  const std::size_t n = r.particles();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) write(a, of_particle(a));
  r.ghosts.fill<how>([&](std::size_t k) { return Vec2(x[k], y[k]); }, write);
}

template <Mirrors how>
void Fluxes::take_velocities(const ReferenceConfiguration& r, std::span<const Vec2> velocities) {
  spread<how>(r, velocity_, [&](std::size_t a) { return velocities[a]; });
  along_interfaces_.take_velocities(velocity_);
}
template void Fluxes::take_velocities<Mirrors::motion>(const ReferenceConfiguration&, std::span<const Vec2>);
template void Fluxes::take_velocities<Mirrors::direction>(const ReferenceConfiguration&,
                                                          std::span<const Vec2>);

void Fluxes::prepare_forces(const ReferenceConfiguration& r, const Model& model,
                            const ZeroEnergySpring& spring, std::vector<double>* flow,
                            WallFriction& friction) {
  take_pressures(r, model);
  if (flow != nullptr) take_viscosities(r, *flow);
  // Takes the velocities' place in the records until the next step, when all have been strained.
  const Particles& p = model.particles;
  if (!controlled_[0].empty())
    spread<Mirrors::motion>(r, controlled_, [&](std::size_t a) {
      return Vec2(p.velocity[a] + spring.of(a, p) * spring.stretch(a, r, p));
    });
  behind_walls_.fill(r, piola_);
  if (friction.active()) friction.apply(r, piola_);
  fill_ghost_fluxes(r, p.fill, flow == nullptr);
}

/// Images in fixed walls have none: they hold the soil by its stress.
void Fluxes::take_viscosities(const ReferenceConfiguration& r, std::vector<double>& viscosity) {
  const std::size_t n = r.particles();
  viscosity.resize(r.points.size());
  r.ghosts.for_each([&](std::size_t i) {
    viscosity[n + i] = r.ghosts.wall(i).kind == BoundaryKind::fixed ? 0 : viscosity[r.ghosts.parent(i)];
  });
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < viscosity.size(); ++i)
    if (r.listed[i] || (i < n && r.stencils.stretch_of[i] == PairStencils::own_list))
      records_[i].q[viscosity_lane] = viscosity[i];
}

void Fluxes::take_pressures(const ReferenceConfiguration& r, const Model& model) {
  if (pressure_.empty()) return;
  const Particles& p = model.particles;
  const std::size_t n = p.size();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) pressure_[a] = p.pore_pressure[a];
  r.ghosts.for_each([&](std::size_t i) {
    const std::size_t parent = r.ghosts.parent(i);
    const Vec2& from = parent < n ? p.position[parent] : ghost_positions_[parent - n];
    ghost_positions_[i] = r.ghosts.wall(i).mirrored(from);
  });
  model.pore_water->fill_ghosts(model.water, p, r.ghosts, ghost_positions_, pressure_);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < pressure_.size(); ++i)
    if (r.listed[i]) records_[i].q[pressure_lane] = pressure_[i];
}

void Fluxes::set_flux(const ReferenceConfiguration& r, std::size_t i, const Mat2& flux) {
  flux_.set(i, flux);
  if (!r.listed[i]) return;
  for (int k = 0; k < 4; ++k) records_[i].q[k] = flux(k / 2, k % 2);
}

/// P = J p_e F^-T.
void Fluxes::take_pressures_alone(const ReferenceConfiguration& r, const std::vector<double>& fill,
                                  const Fluxes& soil, std::span<const double> excess) {
  const auto take = [&](std::size_t i, const Mat2& p, double filled) {
    piola_.set(i, p);
    set_flux(r, i, filled * p * r.correction[i]);
  };
  const std::size_t n = r.particles();
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < n; ++a) {
    const Mat2 f = soil.deformation_[a];
    take(a, excess[a] * (Mat2() << f(1, 1), -f(1, 0), -f(0, 1), f(0, 0)).finished(), fill[a]);
  }
  r.ghosts.for_each([&](std::size_t i) {
    take(n + i, r.ghosts.mirrored<Mirrors::tensor>(i, Mat2(piola_[r.ghosts.parent(i)])),
         fill[r.ghosts.root(i)]);
  });
}

void Fluxes::fill_ghost_fluxes(const ReferenceConfiguration& r, const std::vector<double>& fills,
                               bool fixed_walls_are_seen) {
  const std::size_t n = r.particles();
  r.ghosts.for_each([&](std::size_t i) {
    const std::size_t parent = r.ghosts.parent(i);
    const double fill = fills[r.ghosts.root(i)];
    const bool seen = fixed_walls_are_seen || r.ghosts.wall(i).kind != BoundaryKind::fixed;
    const Mat2 control =
        seen ? Mat2(flux_[parent] - fill * piola_[parent] * r.correction[parent]) : Mat2(Mat2::Zero());
    set_flux(r, n + i, fill * piola_[n + i] * r.correction[n + i] + r.ghosts.mirrored_flux(i, control));
  });
}

void Fluxes::connect(ConsistentArrays& c, const ReferenceConfiguration& r) {
  for (int k = 0; k < 2; ++k) {
    c.motion.velocity[k] = velocity_[k].data();
    c.motion.controlled[k] = (controlled_[0].empty() ? velocity_ : controlled_)[k].data();
  }
  c.motion.pressure = pressure_.empty() ? nullptr : pressure_.data();
  deformation_.connect(c.state.deformation);
  flux_.connect(c.fluxes.flux);
  c.fluxes.listed = r.listed.data();
  c.fluxes.records = records_.data();
  c.fluxes.mirrored = mirrored_.data();
  piola_.connect(c.fluxes.piola);
  along_interfaces_.connect(c.state.own_sides);
}

void Fluxes::visit(StateArchive& state, const ReferenceConfiguration& r) {
  const std::size_t n = r.particles();
  for (auto& component : deformation_.component) state.array("deformation", component);
  for (auto& component : flux_.component) state.array("flux", std::span(component).first(n));
  for (auto& component : piola_.component) state.array("piola", std::span(component).first(n));
  if (!state.restoring()) return;
  for (std::size_t a = 0; a < n; ++a)
    if (r.listed[a])
      for (int k = 0; k < 4; ++k) records_[a].q[k] = flux_.component[k][a];
}

}  // namespace porosph
