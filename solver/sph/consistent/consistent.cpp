#include "solver/sph/consistent/consistent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/sph/consistent/body_contact.hpp"

namespace porosph {
namespace {

/// rho c_p for the zero-energy viscosity: of the lightest soil, whose particles it could otherwise push too
/// far in a step, and of the fastest wave, which sets the step.
double controlled_rho_c(const Model& model) {
  const auto& density = model.particles.density;
  return *std::min_element(density.begin(), density.end()) * model.wave_speed;
}

}  // namespace

double bulk_viscosity_of(const FormulationCase& formulation, const Model& model) {
  constexpr double usual = 0.06;  // by the map cases/stability/refresh_zero_energy.toml
  if (formulation.bulk_viscosity >= 0) return formulation.bulk_viscosity;
  return std::ranges::any_of(model.soils, &Soil::flows) ? 0 : usual;
}

ConsistentDynamics::ConsistentDynamics(const FormulationCase& formulation, Model& model, VectorUnits units)
    : model_(model),
      formulation_(formulation),
      kernels_(consistent_kernels(units)),
      soils_(model),
      surroundings_(model),
      friction_(model),
      control_{
          .rho_c = controlled_rho_c(model), .viscosity = 0, .cells_are_cut = cells_are_cut(model.particles)} {
  control_.viscosity = formulation.zero_energy_control * control_.rho_c * model.smoothing_length;
}

/// By the map cases/stability/refresh_zero_energy.toml; in flow by collapsing columns, which a limit of 0.02
/// lets run out equally far, to 0.5 %, in 1.4 times the time. Elastic bodies keep their neighbours, and each
/// new reference takes what alternates as it is. Soil at rest with an excess pressure keeps its reference:
/// flow and soil would diverge after a renewal, probably because laws and water then see fixed walls
/// differently.
double ConsistentDynamics::refresh_strain() const {
  constexpr double usual = 0.02, in_flow = 0.05, of_bodies = 0.1;
  if (formulation_.refresh_strain >= 0) return formulation_.refresh_strain;
  if (arrays_.state.excess != nullptr) return std::numeric_limits<double>::infinity();
  if (flow_.has_flowed()) return in_flow;
  return surroundings_.bodies_are_apart() ? of_bodies : usual;
}

void ConsistentDynamics::prepare() {
  since_.forces_act = false;
  const bool deformed = since_.strain > refresh_strain();
  if (reference_.made() && !strangers_are_near() && !deformed) return;
  if (!reference_.made())
    flow_ = FlowingSoil(model_, control_.viscosity);
  else if (flow_.active())
    flow_.settle(model_, reference_);
  rebuild_reference();
  take_velocities();
  strain_all(0);
  since_.strain = since_.travel = 0;
  ++counts.refreshes;
}

/// For the particles where they are now, undeformed.
void ConsistentDynamics::rebuild_reference() {
  constexpr double against_impact = 0.6;  // contact acts on single rows: docs/theory.md
  FormulationCase formulation = formulation_;
  if (surroundings_.bodies_are_apart() && formulation.zero_energy_stiffness < 0)
    formulation.zero_energy_stiffness = against_impact;
  if (flow_.has_flowed()) {  // gradients are closed, and zigzag held but under loads, at the start alone
    formulation.closed_gradients = false;
    if (formulation.zero_energy_stiffness < 0 && model_.press != Press::on_soil)
      formulation.zero_energy_stiffness = 0;
  }
  reference_ = make_reference(model_, formulation, surroundings_.find(model_));
  counts.searches = surroundings_.searches();
  counts.closures += reference_.closed() ? 1 : 0;
  soils_.set_own_sides(reference_.own_sides.place);
  control_.spring = ZeroEnergySpring(formulation, model_, control_.rho_c, control_.cells_are_cut, reference_);
  control_.hold = InterfaceHold(reference_, model_);
  const bool asked = control_.spring.active() || !reference_.own_sides.empty() || flow_.active();
  since_.yields.assign(asked ? model_.particles.size() : 0, 0);
  if (flow_.active()) flow_.take(reference_, model_);
  if (friction_.active()) friction_.take(reference_, model_);
  const LooseParticles* loose = flow_.active() ? &flow_.loose() : nullptr;
  fluxes_ = Fluxes(reference_, model_, control_.spring.active(), loose,
                   flow_.has_flowed() ? fluxes_.give_records() : SparselyWritten<Record>());
  if (flow_.active()) fluxes_.keep_piola_of(flow_.wall_work().particles_at_walls());
  since_.of_excess.reset();
  connect_arrays();
}

void ConsistentDynamics::connect_arrays() {
  Particles& p = model_.particles;
  arrays_.reference = reference_.view(p);
  arrays_.state.stress = &p.stress.data()->xx;
  arrays_.state.density = p.density.data();
  arrays_.state.interface_stress = p.interface_stress.data();
  arrays_.state.yields = since_.yields.empty() ? nullptr : since_.yields.data();
  reference_.own_sides.connect(arrays_.state.own_sides);
  arrays_.state.own_sides.rate = control_.spring.of_own_sides().data();
  arrays_.control = {.viscosity = control_.viscosity,
                     .rate = control_.spring.of_soils().data(),
                     .bulk_length = bulk_viscosity_of(formulation_, model_) * model_.smoothing_length};
  if (flow_.active()) {
    arrays_.diffusion = flow_.diffusion().view(p);
    arrays_.flow = {.viscosity = flow_.viscosity().data(),
                    .sheared = flow_.diffusion().sheared(),
                    .bears = flow_.loose().bears(),
                    .deforms = flow_.deforms(),
                    .mass = p.mass.data(),
                    .length_squared = model_.smoothing_length * model_.smoothing_length,
                    .weight = model_.gravity.norm() * model_.spacing};
  }
  arrays_.gravity[0] = model_.gravity.x(), arrays_.gravity[1] = model_.gravity.y();
  fluxes_.connect(arrays_, reference_);
}

bool ConsistentDynamics::strangers_are_near() {
  const double looked_at_after = flow_.has_flowed() ? 0.1 : 0.05;
  if (since_.travel <= looked_at_after * model_.spacing) return false;
  since_.travel = 0;
  const bool found = surroundings_.strangers_are_near(model_, reference_.stencils, reference_.points);
  counts.searches = surroundings_.searches();
  return found;
}

void ConsistentDynamics::take_velocities() {
  fluxes_.take_velocities<Mirrors::motion>(reference_, model_.particles.velocity);
  if (flow_.active()) flow_.take_velocities(reference_, model_.particles);
  since_.others_move = false;
}

/// Carries all particles over a step dt with the velocities taken; dt = 0 only writes the fluxes.
LargestChange ConsistentDynamics::strain_all(double dt) {
  arrays_.state.soils = soils_.view();
  double strain = 0, speed_squared = 0;
  std::vector<std::pair<double, double>> of_tile(flow_.active() ? reference_.stencils.tiles() : 0);
#pragma omp parallel for schedule(static) reduction(max : strain, speed_squared)
  for (std::int32_t tile = 0; tile < reference_.stencils.tiles(); ++tile) {
    LargestChange largest;
    kernels_.strain(arrays_, tile, dt, largest);
    strain = std::max(strain, largest.strain);
    speed_squared = std::max(speed_squared, largest.speed_squared);
    if (flow_.active()) of_tile[tile] = {largest.plastic_work, largest.viscous_work};
  }
  for (const auto& [plastic, viscous] : of_tile) flow_.add_dissipation(plastic, viscous);
  if (flow_.active()) flow_.leave_out_walls(reference_, fluxes_.flux(), fluxes_.records());
  return {strain, speed_squared};
}

void ConsistentDynamics::accelerations(std::span<Vec2> out) {
  since_.forces_act = true;
  if (since_.others_move) take_velocities();
  fluxes_.prepare_forces(reference_, model_, control_.spring, flow_.active() ? &flow_.viscosity() : nullptr,
                         friction_);
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < reference_.stencils.tiles(); ++tile)
    kernels_.accelerate(arrays_, tile, out.data()->data());
  if (friction_.active() && flow_.active()) friction_.sample(reference_, model_.particles);
  fluxes_.add_along_interfaces(reference_, model_.particles, out);
  control_.hold.add_forces(reference_, model_.particles, out);
  add_contact(model_, surroundings_.strangers(model_), out);
  if (flow_.active()) {
    flow_.leave_out_walls(reference_, model_.particles, out);
    flow_.sample_work(reference_, model_.particles, fluxes_.piola());
    flow_.loose().walls().apply(model_, out);
  }
  control_.spring.soften_pairs(
      reference_, model_.particles, control_.viscosity, [&](std::int32_t a) { return own_strain(a); }, out);
}

/// F - I of a particle's own side.
Mat2 ConsistentDynamics::own_strain(std::size_t a) const {
  const Mat2 strain = fluxes_.deformation(a) - Mat2::Identity();
  const std::int32_t place = reference_.own_sides.empty() ? -1 : reference_.own_sides.place[a];
  return place < 0 ? strain : reference_.own_sides.of(place, strain);
}

void ConsistentDynamics::velocity_gradients(std::span<Mat2> out) {
  fluxes_.take_velocities<Mirrors::motion>(reference_, model_.particles.velocity);
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < reference_.stencils.tiles(); ++tile) {
    std::array<PlaneTensor, PairStencils::tile> rate;
    kernels_.rates(arrays_, tile, rate.data()->data());
    const std::size_t first = static_cast<std::size_t>(tile) * PairStencils::tile;
    for (std::size_t a = first; a < std::min(first + PairStencils::tile, out.size()); ++a) {
      const OwnSides& sides = reference_.own_sides;
      const std::int32_t place = sides.empty() ? -1 : sides.place[a];
      Mat2 of_sum = matrix(rate[a - first]);
      if (place >= 0 && fluxes_.along_interfaces().acts())
        of_sum += fluxes_.along_interfaces().change(place) * sides.tangent(place).transpose();
      out[a] = of_sum * inverse(fluxes_.deformation(a));
      if (place >= 0) out[a] = sides.rate_of(place, out[a]);
    }
  }
}

void ConsistentDynamics::excess_accelerations(std::span<const double> excess, std::span<Vec2> out) {
  const Particles& p = model_.particles;
  if (!since_.of_excess) since_.of_excess = Fluxes::of_pressures(reference_);
  since_.of_excess->take_pressures_alone(reference_, p.fill, fluxes_, excess);
  ConsistentArrays arrays = arrays_;
  since_.of_excess->connect(arrays, reference_);
  fluxes_.deformation().connect(arrays.state.deformation);
  arrays.motion.pressure = nullptr;
  arrays.flow.viscosity = nullptr;
  arrays.control.viscosity = 0;
  arrays.gravity[0] = arrays.gravity[1] = 0;
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < reference_.stencils.tiles(); ++tile)
    kernels_.accelerate(arrays, tile, out.data()->data());
}

/// What moves along walls strains nothing, as far as the volume is concerned. Loose particles keep theirs.
void ConsistentDynamics::sliding_rates(std::span<const Vec2> velocities, std::span<Mat2> out) {
  fluxes_.take_velocities<Mirrors::direction>(reference_, velocities);
  since_.others_move = true;
#pragma omp parallel for schedule(static)
  for (std::int32_t tile = 0; tile < reference_.stencils.tiles(); ++tile) {
    std::array<PlaneTensor, PairStencils::tile> rates;
    kernels_.rates(arrays_, tile, rates.data()->data());
    const std::size_t first = static_cast<std::size_t>(tile) * PairStencils::tile;
    for (std::size_t a = first; a < std::min(first + PairStencils::tile, out.size()); ++a)
      out[a] = flow_.active() && flow_.loose().is(a) ? Mat2(Mat2::Zero()) : matrix(rates[a - first]);
  }
}

void ConsistentDynamics::volume_rates(std::span<const Mat2> rates, std::span<double> out, double ahead) {
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < out.size(); ++a) {
    const double carried = flow_.active() ? flow_.deforms()[a] : 1;
    out[a] = (rates[a] * inverse(fluxes_.deformation(a) + ahead * carried * rates[a])).trace();
  }
}

void ConsistentDynamics::strain(double dt, std::span<const double> volume_rates) {
  if (flow_.active()) {
    flow_.loose().walls().stepped(dt);
    if (since_.forces_act) flow_.count_work(reference_, model_.particles, dt);
    if (since_.forces_act && friction_.active()) friction_.count(model_.particles, dt);
    flow_.diffuse_stress(model_, kernels_, arrays_);
  }
  take_velocities();
  const double at_walls = flow_.active() ? flow_.deform_at_walls(dt, fluxes_.deformation()) : 0;
  arrays_.state.volume_rate = volume_rates.data();
  const LargestChange largest = strain_all(dt);
  arrays_.state.volume_rate = nullptr;
  since_.strain = std::max(at_walls, largest.strain);
  if (friction_.active()) friction_.slide(model_, dt);
  since_.travel += dt * std::sqrt(largest.speed_squared);
  if (control_.spring.active())
    control_.spring.slip(reference_, model_.particles, since_.yields,
                         [&](std::int32_t a) { return own_strain(a); });
}

void ConsistentDynamics::visit(StateArchive& state) {
  bool made = reference_.made();
  state.value("has_reference", made);
  if (!made) return;
  if (state.restoring()) flow_ = FlowingSoil(model_, control_.viscosity);
  flow_.visit(state);
  friction_.visit(state);
  Particles& p = model_.particles;
  std::vector<Vec2> positions(p.size());
  std::vector<double> densities(p.size());
  if (!state.restoring()) {
    std::copy_n(reference_.points.begin(), p.size(), positions.begin());
    densities = reference_.density;
  }
  state.array("reference_position", positions);
  state.array("reference_density", densities);
  if (state.restoring()) {  // the reference is rebuilt from where the particles were at its making
    p.position.swap(positions), p.density.swap(densities);
    rebuild_reference();
    p.position.swap(positions), p.density.swap(densities);
    connect_arrays();
    take_velocities();
  }
  surroundings_.visit(state, model_);
  fluxes_.visit(state, reference_);
  control_.spring.visit(state, p.size());
  state.value("largest_strain", since_.strain);
  state.value("travel", since_.travel);
}

}  // namespace porosph
