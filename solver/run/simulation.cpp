#include "solver/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/case/local_origin.hpp"
#include "solver/case/shapes.hpp"
#include "solver/model/soil_law.hpp"
#include "solver/run/highest_frequency.hpp"
#include "solver/run/kept_state.hpp"
#include "solver/run/monitor/energy.hpp"
#include "solver/space/parallel.hpp"

namespace porosph {

namespace {

/// Kicks and moves particles first to last - 1; returns how many of them are faster than `limit`, the square
/// of a speed, or not finite, or turned inside out. One loop over plain numbers, so that it becomes vector
/// code.
std::int64_t move_particles(std::size_t first, std::size_t last, Kick kick, double dt, double limit,
                            Particles& p, std::span<const Vec2> accelerations) {
  double *v = p.velocity.data()->data(), *x = p.position.data()->data();
  const double *a = accelerations.data()->data(), *density = p.density.data();
  std::int64_t runaways = 0;
#pragma omp simd reduction(+ : runaways)
  for (std::size_t i = first; i < last; ++i) {
    const double vx = kick.keep * v[2 * i] + kick.gain * a[2 * i];
    const double vy = kick.keep * v[2 * i + 1] + kick.gain * a[2 * i + 1];
    v[2 * i] = vx, v[2 * i + 1] = vy;
    x[2 * i] += dt * vx, x[2 * i + 1] += dt * vy;
    runaways += vx * vx + vy * vy < limit && density[i] > 0 ? 0 : 1;
  }
  return runaways;
}

/// In a stage a probe reads the soil that it is in, and is nowhere until that is there.
Probe make_probe(const ProbeCase& probe, const Case& scene, const Model& model) {
  if (!scene.plan) return Probe(probe, model);
  for (const SoilCase& soil : scene.soils)
    if (distance(probe.position, soil) <= 0) return Probe(probe, model, soil.id);
  return Probe::nowhere(probe);
}

/// Mass, and displacement that does not count, are not as in the case where the state of another was taken
/// over.
void visit_particles(StateArchive& state, Particles& p) {
  p.for_each_changing([&](std::string_view name, auto& values) { state.array(name, values); });
  state.array("mass", p.mass);
  bool recounted = !p.uncounted.empty();
  state.value("recounted", recounted);
  if (!recounted) return;
  p.uncounted.resize(p.size());
  state.array("uncounted", p.uncounted);
}

}  // namespace

Simulation::Simulation(const Case& scene, const DynamicsMaker& dynamics)
    : Simulation(scene, Beginning{}, dynamics) {}

Simulation::Simulation(const Case& scene, const Beginning& beginning, const DynamicsMaker& dynamics)
    : scene_(scene),
      model_(build_model(scene)),
      dynamics_(dynamics(scene.formulation, model_)),
      surface_(surface_forces(moved(scene, -model_.origin), model_)),
      motion_{.base = BaseMotion(scene.shaking), .water = {}},
      clock_(make_clock(scene, model_, beginning.time)),
      watch_(scene, model_) {
  if (!scene.stages.empty())
    throw std::runtime_error("the case has stages ([[stage]]), which porosph run and porosph check follow");
  forces_.accelerations.assign(model_.particles.size(), Vec2::Zero());
  for (const ProbeCase& probe : scene.probes) probes_.push_back(make_probe(probe, scene, model_));
  if (scene.water.couples() && scene.water.coupling.motion != WaterMotion::quasi_static)
    motion_.water = std::make_unique<DynamicWater>(moved(scene, -model_.origin), model_, *dynamics_);
  motion_.now = scene.water.is_dynamic();
  if (scene.water.couples() && !motion_.now) couple();
  flow_.seepage = std::dynamic_pointer_cast<TransientWater>(model_.pore_water);
  if (flow_.seepage) time_by_flow();
  take_over(beginning, scene, model_);
  to_rest_.inertia = ScaledInertia(scene, model_);
  if (beginning.state == nullptr) return;
  for (Footing& footing : surface_.footings) {
    const auto there = beginning.state->settlements.find(footing.name());
    footing.place(model_.particles, there == beginning.state->settlements.end() ? 0 : there->second);
  }
  for (Sheet& sheet : surface_.sheets) {
    const auto there = beginning.state->sheets.find(sheet.name());
    sheet.place(model_.particles, there == beginning.state->sheets.end() ? nullptr : &there->second);
  }
}

HandedOver Simulation::hand_over() {
  HandedOver state{scene_, model_.particles, model_.origin};
  state.particles.velocity = velocities();
  for (const Footing& footing : surface_.footings)
    state.settlements[footing.name()] = footing.settlement(model_.particles);
  for (const Sheet& sheet : surface_.sheets) state.sheets[sheet.name()] = sheet.state(model_.particles);
  return state;
}

void Simulation::set_law(const std::string& soil, AnyLaw law) {
  const auto& soils = scene_.soils;
  const auto found = std::ranges::find(soils, soil, &SoilCase::name);
  if (found == soils.end()) throw std::invalid_argument(fmt::format("no soil is called '{}'", soil));
  Soil& old = model_.soils[found - soils.begin()];
  Soil changed(std::move(law), false, old.id());
  if (changed.constrained_modulus() > old.constrained_modulus() * (1 + 1e-12))
    throw std::invalid_argument(
        fmt::format("the law of soil '{}' has the modulus M = {:g} Pa, but the time step is for {:g} Pa",
                    soil, changed.constrained_modulus(), old.constrained_modulus()));
  changed.add_history(model_.particles);
  changed.start_history(model_.particles, static_cast<std::int32_t>(found - soils.begin()));
  old = std::move(changed);
}

void Simulation::couple() {
  flow_.coupled =
      std::make_unique<Consolidation>(moved(scene_, -model_.origin), model_, *dynamics_, surface_, clock_.dt);
  time_by_flow();
}

/// Steps of the flow end on ticks.
void Simulation::time_by_flow() {
  if (scene_.time.step > 0)
    throw std::runtime_error("time.step: a coupled run chooses its steps, and cannot be given a later end");
  flow_.settling.dt = clock_.dt;
  clock_.count_ticks_until(scene_.time.end, may_lose_equilibrium() ? clock_.dt : never);
  if (may_lose_equilibrium() && clock_.dt > flow_.settling.dt)
    throw std::runtime_error(
        fmt::format("time.end = {:g} s: is too long to count in steps of {:.2g} s, which "
                    "soil takes that has failed (water.motion)",
                    scene_.time.end, flow_.settling.dt));
}

/// One step of the flow; returns whether the soil is to follow it: something is due where it has got to.
bool Simulation::follow_flow() {
  if (clock_.ended()) return false;
  const std::int64_t due = next_due();
  try {
    clock_.reach(flow_.advance(time(), clock_.at(due)), due);
  } catch (const std::runtime_error& failure) {
    stop({.cause = Cause::not_at_rest, .time = time(), .message = failure.what()});
    return false;
  }
  return clock_.step == due;
}

bool Simulation::may_lose_equilibrium() const {
  return scene_.water.coupling.motion == WaterMotion::automatic;
}

void Simulation::advance_flow() {
  std::optional<KeptState> at_rest;
  if (may_lose_equilibrium()) at_rest.emplace(*this);
  follow_flow();
  if (!instability()) return take_accelerations_at_rest();
  if (!at_rest) return;
  const double lost = flow_.coupled->time();
  at_rest->restore(*this);
  watch_.forget();
  if (flow_.coupled->seek_failure(time(), lost)) return;
  clock_.reach(lost, next_due());
  begin_motion();
}

void Simulation::take_accelerations_at_rest() {
  const auto left = flow_.coupled->accelerations();
  forces_.accelerations.assign(left.begin(), left.end());
  forces_.unheld.clear();
  forces_.valid = true;
}

void Simulation::advance_seepage() {
  if (!follow_flow()) return;
  flow_.seepage->tell();
  if (!may_lose_equilibrium()) return settle();
  const KeptState at_rest(*this);
  settle();
  if (!instability()) return;
  at_rest.restore(*this);
  begin_motion();
}

void Simulation::begin() {
  if (!flow_.seepage || instability()) return;
  settle();
  Particles& p = model_.particles;
  p.uncounted.resize(p.size());
  for (std::size_t a = 0; a < p.size(); ++a) p.uncounted[a] = p.position[a] - p.start[a];
}

void Simulation::settle() {
  model_.pore_water->follow(model_.water, model_.particles, 0, model_.particles.size());
  if (scene_.water.transient.rigid) return;
  const double given = scene_.stop.unbalanced_force_ratio;
  const bool rests = flow_.settling.settle(model_, *dynamics_,
                                           {.forces =
                                                [this] {
                                                  forces_.valid = false;
                                                  return accelerations();
                                                },
                                            .ratio = [this] { return unbalanced_force_ratio(); },
                                            .enough = given > 0 ? given : Settling::usually_enough});
  forces_.valid = false;
  if (rests) return;
  stop({.cause = Cause::not_at_rest,
        .time = time(),
        .message = fmt::format("at {:.6g} s the soil does not come to rest in the flow: it fails (unbalanced "
                               "force ratio {:.2g}, largest displacement {:.3g} m)",
                               time(), unbalanced_force_ratio(), largest_displacement())});
}

void Simulation::reduce_strength(double factor) {
  porosph::reduce_strength(model_, scene_, factor);
  for (Sheet& sheet : surface_.sheets) sheet.reduce_strength(factor);
}

double Simulation::damping() const {
  const LoadingCase& loading = scene_.loading;
  if (time() >= loading.damping_until) return 0;
  return loading.adaptive_damping ? to_rest_.relaxation.damping : loading.damping / step_length();
}

std::span<const Vec2> Simulation::accelerations() {
  if (!forces_.valid) {
    if (motion_.now) model_.pore_water->follow(model_.water, model_.particles, 0, model_.particles.size());
    sum_forces();
    if (motion_.now) show_excess();
    forces_.valid = true;
  } else if (!forces_.unheld.empty() && forces_.held_in != next_kick()) {  // the damping has changed since
    forces_.accelerations = forces_.unheld;
    hold_soil(forces_.accelerations);
  }
  return forces_.accelerations;
}

/// Where pressure moves with the soil, p_w is that of the water that stands meanwhile.
void Simulation::sum_forces() {
  std::vector<Vec2>& a = forces_.accelerations;
  DynamicWater* water = motion_.acting();
  water != nullptr ? water->prepare() : dynamics_->prepare();
  dynamics_->accelerations(a);
  if (water != nullptr) water->add_force(a);
  surface_.press(model_, time(), a);
  motion_.base.push(time(), a);
  if (flow_.seepage) flow_.seepage->add_weight(model_.particles, model_.gravity, a);
  forces_.unheld.clear();
  if (!surface_.hold_soil()) return;
  forces_.unheld = a;
  hold_soil(a);
}

void Simulation::hold_soil(std::span<Vec2> accelerations) {
  forces_.held_in = next_kick();
  surface_.hold(model_, forces_.held_in, step_length(), clock_.then(), accelerations);
}

std::vector<Vec2> Simulation::velocities() {
  std::vector<Vec2> v = model_.particles.velocity;
  if (moves() == 0 || rests_in_flow()) return v;
  const auto by_mass = accelerations();
  std::vector<Vec2> a(by_mass.begin(), by_mass.end());
  inertia().scale(a);
  const Kick kick = half_kick(damping(), step_length());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = kick(v[i], a[i]);
  return v;
}

void Simulation::advance() {
  if (instability()) return;
  if (rests_in_flow()) return flow_.coupled ? advance_flow() : advance_seepage();
  advance_in_motion();
}

void Simulation::advance_in_motion() {
  choose_ticks();
  accelerations();
  const bool measure = scene_.loading.adaptive_damping && clock_.step % Relaxation::steps_between == 0;
  const std::vector<Vec2> before = measure ? forces_.accelerations : std::vector<Vec2>();
  if (motion_.water && !change_pressure()) return;
  if (motion_.base.acts())
    motion_.base.count_work(time(), model_.particles, next_kick(), forces_.accelerations);
  drift();
  for (Sheet& sheet : surface_.sheets) sheet.take_step();
  forces_.valid = false;
  if (motion_.energy_when_lost) count_changing_loads();
  clock_.go_on();
  if (instability()) return;
  const std::span<const double> of_water =
      motion_.water ? motion_.water->take_strain(step_length(), surface_.sheets.empty())
                    : std::span<const double>();
  dynamics_->strain(step_length(), of_water);
  model_.pore_water->flow(model_.water, model_.particles, step_length());
  if (motion_.now) show_excess();
  if (!measure) return;
  const ScaledInertia& inertia = to_rest_.inertia;
  const std::vector<Vec2>& v = model_.particles.velocity;
  to_rest_.relaxation.measure(model_.particles, before, accelerations(), step_length(),
                              inertia.acts() ? std::optional(2 * inertia.kinetic_energy(v)) : std::nullopt);
}

Kick Simulation::next_kick() const {
  return (moves() == 0 ? first_kick : full_kick)(damping(), step_length());
}

/// v^{n+1/2} and x^{n+1}, and the pore pressure there.
void Simulation::drift() {
  Particles& p = model_.particles;
  const Kick kick = next_kick();
  const bool wet = model_.pore_water->acts(model_.water);
  const double then = clock_.then();
  model_.water.set_time(then);
  const double limit = model_.wave_speed * model_.wave_speed;
  const std::span<const Vec2> a =
      inertia().acts() ? to_rest_.inertia.take_step(forces_.accelerations) : forces_.accelerations;
  std::int64_t runaways = 0;
#pragma omp parallel reduction(+ : runaways)
  {
    const auto [first, last] = thread_range(p.size());
    runaways = move_particles(first, last, kick, step_length(), limit, p, a);
    if (wet) model_.pore_water->follow(model_.water, p, first, last);
  }
  watch_.after_step(runaways, model_, then);
}

void Simulation::visit(StateArchive& state) {
  bool prepared = forces_.valid;
  Dynamics::Counts &counts = dynamics_->counts, counts_then = counts;
  state.value("step", clock_.step);
  state.value("prepared", prepared);
  state.value("searches", counts_then.searches);
  state.value("refreshes", counts_then.refreshes);
  state.value("closures", counts_then.closures);
  visit_particles(state, model_.particles);
  if (state.restoring()) to_rest_.inertia = ScaledInertia(scene_, model_);  // masses may be another run's
  to_rest_.inertia.visit(state);
  for (Footing& footing : surface_.footings) footing.visit(state);
  for (Sheet& sheet : surface_.sheets) sheet.visit(state);
  good_.visit(state, model_.particles);
  to_rest_.relaxation.visit(state, "relaxation");
  dynamics_->visit(state);
  model_.pore_water->visit(state);
  if (flow_.coupled) flow_.coupled->visit(state);
  if (flow_.seepage) flow_.settling.visit(state);
  if (scene_.water.flows_over_time()) visit_motion(state);
  if (motion_.base.acts()) motion_.base.visit(state);
  if (!state.restoring()) return;
  model_.water.set_time(time());
  forces_.valid = false;
  if (prepared) flow_.coupled && !motion_.now ? take_accelerations_at_rest() : void(accelerations());
  counts = counts_then;
}

void Simulation::remember() {
  const auto a = accelerations();
  good_.remember({model_.particles, {a.begin(), a.end()}, clock_.step});
}

bool Simulation::exchange_with_last_good() {
  if (!good_.exchange(model_.particles, forces_.accelerations, clock_.step)) return false;
  forces_.unheld.clear();
  forces_.valid = true;
  return true;
}

std::optional<double> Simulation::drained() const {
  if (flow_.seepage) return std::nullopt;  // it has a balance of its own
  if (const DynamicWater* water = water_in_motion()) return water->drained();
  if (flow_.coupled) return flow_.coupled->drained();
  return std::nullopt;
}

double Simulation::largest_displacement() const {
  const Particles& p = model_.particles;
  double squared = 0;
  for (std::size_t i = 0; i < p.size(); ++i) squared = std::max(squared, p.displacement(i).squaredNorm());
  return std::sqrt(squared);
}

double Simulation::unbalanced_force_ratio() {
  const auto a = accelerations();
  return porosph::unbalanced_force_ratio(model_, a, surface_.squares(time()));
}

Simulation::Energy Simulation::energy() {
  const std::vector<Vec2> v = velocities();
  const DynamicWater* water = water_in_motion();
  const double of_excess = water != nullptr ? water->energy() - water->shown_energy() : 0;
  return {.kinetic = inertia().acts() ? inertia().kinetic_energy(v) : kinetic_energy(model_.particles, v),
          .elastic = elastic_energy(model_),
          .gravity = gravity_energy(model_) + load_energy(surface_.loads, model_.particles, time()),
          .water = water_energy(model_) + of_excess};
}

}  // namespace porosph
