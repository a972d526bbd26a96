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
#include "solver/space/place_text.hpp"

namespace porosph {

namespace {

/// omega h / c_p of a lattice, at its corners, for which Courant numbers are meant.
constexpr double lattice_frequency = 1.7;

/// The case's, or less where disorder makes single particles stiffer than they are in a lattice.
double courant_number(const Case& scene, const Model& model) {
  if (scene.particles.arrangement != Arrangement::disordered) return scene.time.courant;
  const double frequency =
      highest_frequency(scene.formulation, model) * model.smoothing_length / model.wave_speed;
  return scene.time.courant * std::min(1.0, lattice_frequency / frequency);
}

/// The case's, or else the largest that the Courant number allows, rounded down so that whole steps reach the
/// end time [s].
double time_step_of(const Case& scene, const Model& model, double courant, double start) {
  const double largest = courant * model.smoothing_length / model.wave_speed;
  const double given = scene.time.step;
  if (given > largest * (1 + 1e-12))
    throw std::runtime_error(fmt::format(
        "time.step = {:g} s: must be <= {:g} s, as the Courant number is {:g}", given, largest, courant));
  if (given > 0) return given;
  const double duration = scene.time.end - start;
  return duration / std::ceil(duration / largest * (1 - 1e-12));
}

/// Kicks and moves particles first to last - 1; returns how many of them are faster than `limit`, the square
/// of a speed, or not finite, or turned inside out. One loop over plain numbers, so that it becomes vector
/// code.
std::int64_t move_particles(std::size_t first, std::size_t last, Kick kick, double dt, double limit,
                            Particles& p, const std::vector<Vec2>& accelerations) {
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

/// What the case does not give where the state of another was taken over.
void visit_taken_over(StateArchive& state, Particles& p) {
  bool recounted = !p.uncounted.empty();
  state.array("mass", p.mass);
  state.value("recounted", recounted);
  if (!recounted) return;
  p.uncounted.resize(p.size());
  state.array("uncounted", p.uncounted);
}

void visit_particles(StateArchive& state, Particles& p) {
  p.for_each_changing([&](std::string_view name, auto& values) { state.array(name, values); });
}

}  // namespace

Simulation::Simulation(const Case& scene, const DynamicsMaker& dynamics)
    : Simulation(scene, Beginning{}, dynamics) {}

Simulation::Simulation(const Case& scene, const Beginning& beginning, const DynamicsMaker& dynamics)
    : scene_(scene),
      model_(build_model(scene)),
      dynamics_(dynamics(scene.formulation, model_)),
      surface_loads_(surface_loads(moved(scene, -model_.origin), model_)),
      footings_(make_footings(moved(scene, -model_.origin), model_)),
      accelerations_(model_.particles.size(), Vec2::Zero()) {
  if (!scene.stages.empty())
    throw std::runtime_error("the case has stages ([[stage]]), which porosph run and porosph check follow");
  clock_.start = beginning.time;
  clock_.courant = courant_number(scene, model_);
  clock_.dt = time_step_of(scene, model_, clock_.courant, clock_.start);
  clock_.last_step = std::llround(std::ceil((scene.time.end - clock_.start) / clock_.dt * (1 - 1e-12)));
  for (const ProbeCase& probe : scene.probes) probes_.push_back(make_probe(probe, scene, model_));
  if (scene.water.flows_over_time() && scene.water.coupling.motion != WaterMotion::quasi_static)
    moving_water_ = std::make_unique<DynamicWater>(moved(scene, -model_.origin), model_, *dynamics_);
  in_motion_ = scene.water.is_dynamic();
  if (scene.water.couples() && !in_motion_) couple();
  seepage_ = std::dynamic_pointer_cast<TransientWater>(model_.pore_water);
  if (seepage_) time_by_flow();
  at_start_.closest = closest_distance(model_.particles.position, 2 * model_.spacing);
  if (scene.stop.on_separation)
    at_start_.bodies = find_bodies(model_.particles.position, 2 * model_.smoothing_length).count;
  if (beginning.state == nullptr) return;
  take_over(beginning, scene, model_);
  taken_over_ = true;
  for (Footing& footing : footings_) {
    const auto there = beginning.state->settlements.find(footing.name());
    footing.place(model_.particles, there == beginning.state->settlements.end() ? 0 : there->second);
  }
}

HandedOver Simulation::hand_over() {
  HandedOver state{scene_, model_.particles, model_.origin};
  state.particles.velocity = velocities();
  for (const Footing& footing : footings_)
    state.settlements[footing.name()] = footing.settlement(model_.particles);
  return state;
}

void Simulation::set_law(const std::string& soil, AnyLaw law) {
  const auto& soils = scene_.soils;
  const auto found = std::ranges::find(soils, soil, &SoilCase::name);
  if (found == soils.end()) throw std::invalid_argument(fmt::format("no soil is called '{}'", soil));
  Soil& old = model_.soils[found - soils.begin()];
  Soil changed(std::move(law));
  if (changed.constrained_modulus() > old.constrained_modulus() * (1 + 1e-12))
    throw std::invalid_argument(
        fmt::format("the law of soil '{}' has the modulus M = {:g} Pa, but the time step is for {:g} Pa",
                    soil, changed.constrained_modulus(), old.constrained_modulus()));
  changed.add_history(model_.particles);
  changed.start_history(model_.particles, static_cast<std::int32_t>(found - soils.begin()));
  old = std::move(changed);
}

void Simulation::couple() {
  consolidation_ = std::make_unique<Consolidation>(moved(scene_, -model_.origin), model_, *dynamics_,
                                                   surface_loads_, footings_, clock_.dt);
  time_by_flow();
}

/// Steps of the flow end on ticks.
void Simulation::time_by_flow() {
  if (scene_.time.step > 0)
    throw std::runtime_error("time.step: a coupled run chooses its steps, and cannot be given a later end");
  settling_.dt = clock_.dt;
  clock_.last_step = std::int64_t{1} << 40;
  clock_.dt = scene_.time.end / static_cast<double>(clock_.last_step);
}

/// The next time at which something is written, as Schedule counts it.
std::int64_t Simulation::next_tick_due() const {
  const OutputCase& output = scene_.output;
  std::int64_t due = clock_.last_step;
  const auto offer = [&](double time) {
    if (const std::int64_t tick = std::llround(time / clock_.dt); tick > clock_.step)
      due = std::min(due, tick);
  };
  if (in_motion_) {
    const double interval = scene_.water.coupling.motion_interval;
    const std::int64_t next = motion_tick(std::floor((time() - failed_at_) / interval + 1e-9) + 1);
    return std::min(due, std::max(next, clock_.step + 1));
  }
  for (const double interval : {output.interval, output.history_interval})
    if (interval > 0) offer((std::floor(time() / interval + 1e-9) + 1) * interval);
  for (const double time : output.times) offer(time);
  return due;
}

void Simulation::advance_flow() {
  if (clock_.step >= clock_.last_step) return;
  const std::int64_t due = next_tick_due();
  const double until = static_cast<double>(due) * clock_.dt;
  try {
    const double reached = consolidation_->advance(time(), until);
    clock_.step =
        reached < until ? std::clamp(std::llround(reached / clock_.dt), clock_.step + 1ll, due - 1ll) : due;
  } catch (const std::runtime_error& failure) {
    instability_ = Breakdown{.cause = Cause::not_at_rest, .time = time(), .message = failure.what()};
    return;
  }
  take_accelerations_at_rest();
}

void Simulation::take_accelerations_at_rest() {
  const auto forces = consolidation_->accelerations();
  accelerations_.assign(forces.begin(), forces.end());
  accelerations_valid_ = true;
}

/// Where something is written the soil follows.
void Simulation::advance_seepage() {
  if (clock_.step >= clock_.last_step) return;
  const std::int64_t due = next_tick_due();
  const double until = static_cast<double>(due) * clock_.dt;
  try {
    const double reached = seepage_->advance(time(), until);
    clock_.step =
        reached < until ? std::clamp(std::llround(reached / clock_.dt), clock_.step + 1ll, due - 1ll) : due;
  } catch (const std::runtime_error& failure) {
    instability_ = Breakdown{.cause = Cause::not_at_rest, .time = time(), .message = failure.what()};
    return;
  }
  if (clock_.step < due) return;
  seepage_->tell();
  if (scene_.water.coupling.motion != WaterMotion::automatic) return settle();
  const KeptState at_rest(*this);
  settle();
  if (!instability_) return;
  instability_.reset();
  at_rest.restore(*this);
  begin_motion();
}

void Simulation::begin() {
  if (!seepage_ || instability_) return;
  settle();
  Particles& p = model_.particles;
  p.uncounted.resize(p.size());
  for (std::size_t a = 0; a < p.size(); ++a) p.uncounted[a] = p.position[a] - p.start[a];
}

void Simulation::settle() {
  model_.pore_water->follow(model_.water, model_.particles, 0, model_.particles.size());
  if (scene_.water.transient.rigid) return;
  const double given = scene_.stop.unbalanced_force_ratio;
  const bool rests = settling_.settle(model_, *dynamics_,
                                      {.forces =
                                           [this] {
                                             accelerations_valid_ = false;
                                             return accelerations();
                                           },
                                       .ratio = [this] { return unbalanced_force_ratio(); },
                                       .enough = given > 0 ? given : Settling::usually_enough});
  accelerations_valid_ = false;
  if (rests) return;
  instability_ = Breakdown{
      .cause = Cause::not_at_rest,
      .time = time(),
      .message = fmt::format("at {:.6g} s the soil does not come to rest in the flow: it fails (unbalanced "
                             "force ratio {:.2g}, largest displacement {:.3g} m)",
                             time(), unbalanced_force_ratio(), largest_displacement())};
}

void Simulation::reduce_strength(double factor) { porosph::reduce_strength(model_, scene_, factor); }

double Simulation::damping() const {
  const LoadingCase& loading = scene_.loading;
  if (time() >= loading.damping_until) return 0;
  return loading.adaptive_damping ? relaxation_.damping : loading.damping / step_length();
}

std::span<const Vec2> Simulation::accelerations() {
  if (!accelerations_valid_) {
    if (in_motion_) model_.pore_water->follow(model_.water, model_.particles, 0, model_.particles.size());
    sum_forces();
    if (in_motion_) show_excess();
    accelerations_valid_ = true;
  }
  return accelerations_;
}

/// Where pressure moves with the soil, p_w is that of the water that stands meanwhile.
void Simulation::sum_forces() {
  in_motion_ ? moving_water_->prepare() : dynamics_->prepare();
  dynamics_->accelerations(accelerations_);
  add_loads(model_.loads, model_.particles, time(), accelerations_);
  add_surface_loads(surface_loads_, model_.particles, time(), accelerations_);
  if (seepage_) seepage_->add_weight(model_.particles, model_.gravity, accelerations_);
  if (in_motion_ && !footings_.empty()) unheld_ = accelerations_;
  hold_footings();
}

void Simulation::hold_footings() {
  for (Footing& footing : footings_)
    footing.hold(model_.particles, next_kick(), step_length(), time_of(clock_.step + clock_.ticks),
                 accelerations_);
}

std::vector<Vec2> Simulation::velocities() {
  std::vector<Vec2> v = model_.particles.velocity;
  if (moves() == 0 || rests_in_flow()) return v;
  const auto a = accelerations();
  const Kick kick = half_kick(damping(), step_length());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = kick(v[i], a[i]);
  return v;
}

void Simulation::advance() {
  if (instability_) return;
  if (rests_in_flow()) return consolidation_ ? advance_flow() : advance_seepage();
  advance_in_motion();
}

void Simulation::advance_in_motion() {
  choose_ticks();
  accelerations();
  const bool measure = scene_.loading.adaptive_damping && clock_.step % Relaxation::steps_between == 0;
  const std::vector<Vec2> before = measure ? accelerations_ : std::vector<Vec2>();
  try {
    if (in_motion_) change_pressure();
  } catch (const DynamicWater::Lost& lost) {
    const Vec2 place = model_.particles.position[lost.particle] + model_.origin;
    instability_ =
        Breakdown{.cause = Cause::inverted,
                  .time = time(),
                  .message = fmt::format("at {:.6g} s the pore pressure no longer follows the volume of "
                                         "the soil around {}: it has yielded too far",
                                         time(), place_text(place))};
    return;
  }
  drift();
  accelerations_valid_ = false;
  clock_.step += clock_.ticks;
  ++clock_.moves;
  if (instability_) return;
  dynamics_->strain(step_length());
  model_.pore_water->flow(model_.water, model_.particles, step_length());
  if (in_motion_) show_excess();
  if (measure) relaxation_.measure(model_.particles, before, accelerations(), step_length());
}

Kick Simulation::next_kick() const {
  return (moves() == 0 ? first_kick : full_kick)(damping(), step_length());
}

/// v^{n+1/2} and x^{n+1}, and the pore pressure there.
void Simulation::drift() {
  Particles& p = model_.particles;
  const Kick kick = next_kick();
  const bool wet = model_.pore_water->acts(model_.water);
  const double then = time_of(clock_.step + clock_.ticks);
  model_.water.set_time(then);
  const double limit = model_.wave_speed * model_.wave_speed;
  std::int64_t runaways = 0;
#pragma omp parallel reduction(+ : runaways)
  {
    const auto [first, last] = thread_range(p.size());
    runaways = move_particles(first, last, kick, step_length(), limit, p, accelerations_);
    if (wet) model_.pore_water->follow(model_.water, p, first, last);
  }
  runaway_ = runaways > 0;
  if (runaway_) name_breakdown(then);
}

void Simulation::visit(StateArchive& state) {
  bool prepared = accelerations_valid_;
  Dynamics::Counts &counts = dynamics_->counts, counts_then = counts;
  state.value("taken_over", taken_over_);
  if (taken_over_ || seepage_) visit_taken_over(state, model_.particles);
  state.value("step", clock_.step);
  state.value("prepared", prepared);
  state.value("searches", counts_then.searches);
  state.value("refreshes", counts_then.refreshes);
  state.value("closures", counts_then.closures);
  visit_particles(state, model_.particles);
  for (Footing& footing : footings_) footing.visit(state);
  for (std::optional<State>* remembered : {&good_.last, &good_.before}) visit_remembered(state, *remembered);
  state.value("relaxation_stiffness", relaxation_.stiffness);
  state.value("relaxation_inertia", relaxation_.inertia);
  state.value("relaxation_damping", relaxation_.damping);
  dynamics_->visit(state);
  model_.pore_water->visit(state);
  if (consolidation_) consolidation_->visit(state);
  if (seepage_) settling_.visit(state);
  if (moving_water_) visit_motion(state);
  if (!state.restoring()) return;
  model_.water.set_time(time());
  accelerations_valid_ = false;
  if (prepared) consolidation_ && !in_motion_ ? take_accelerations_at_rest() : void(accelerations());
  counts = counts_then;
}

void Simulation::visit_remembered(StateArchive& state, std::optional<State>& remembered) const {
  bool is_there = remembered.has_value();
  state.value("remembered", is_there);
  if (!is_there) return remembered.reset();
  if (state.restoring()) remembered = State{model_.particles, accelerations_, 0};
  state.value("remembered_step", remembered->step);
  visit_particles(state, remembered->particles);
  state.array("remembered_accelerations", remembered->accelerations);
}

/// What the conventional form throws off is fast in the end, but that it left is what went wrong first.
void Simulation::name_breakdown(double time) {
  instability_ = find_runaway(model_, time);
  const bool throws_off = scene_.formulation.motion == Motion::conventional && scene_.stop.on_separation;
  if (!throws_off || instability_->cause != Cause::too_fast) return;
  for (const Vec2& x : model_.particles.position)
    if (!x.allFinite()) return;
  if (auto separation = find_separation(model_, at_start_.bodies, time)) instability_ = std::move(separation);
}

void Simulation::look_for_breakdown() {
  constexpr double met = 0.25;  // of the smallest distance at the start
  const bool flows = std::ranges::any_of(model_.soils, &Soil::flows);  // particles keep meeting new ones
  if (!instability_ && !flows) instability_ = find_crossing(model_, met * at_start_.closest, time());
  if (!instability_) instability_ = find_too_stiff(model_, time());
  if (!instability_) instability_ = find_beyond_wall(model_, time());
  if (scene_.stop.on_separation && !instability_)
    instability_ = find_separation(model_, at_start_.bodies, time());
}

void Simulation::remember() {
  good_.before = std::move(good_.last);
  const auto a = accelerations();
  good_.last = State{model_.particles, {a.begin(), a.end()}, clock_.step};
}

bool Simulation::exchange_with_last_good() {
  std::optional<State>& good = good_.before ? good_.before : good_.last;
  if (!good) return false;
  std::swap(model_.particles, good->particles);
  std::swap(accelerations_, good->accelerations);
  std::swap(clock_.step, good->step);
  accelerations_valid_ = true;
  return true;
}

std::optional<double> Simulation::drained() const {
  if (seepage_) return std::nullopt;  // it has a balance of its own
  if (const DynamicWater* water = water_in_motion()) return water->drained();
  if (consolidation_) return consolidation_->drained();
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
  double squares = load_squares(surface_loads_, time());
  for (const Footing& footing : footings_) squares += footing.squares();
  return porosph::unbalanced_force_ratio(model_, a, squares);
}

Simulation::Energy Simulation::energy() {
  const std::vector<Vec2> v = velocities();
  const double of_excess = in_motion_ ? moving_water_->energy() - moving_water_->shown_energy() : 0;
  return {.kinetic = kinetic_energy(model_.particles, v),
          .elastic = elastic_energy(model_),
          .gravity = gravity_energy(model_) + load_energy(surface_loads_, model_.particles, time()),
          .water = water_energy(model_) + of_excess};
}

}  // namespace porosph
