#include "solver/run/strength_reduction.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "solver/boundary/traction.hpp"
#include "solver/case/safety_obstacle.hpp"
#include "solver/run/kept_state.hpp"
#include "solver/run/monitor/energy.hpp"
#include "solver/soil/law_fields.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

constexpr double balanced = 1e-4;                       // unbalanced force ratio at rest
constexpr std::int64_t most_periods = 40;               // until a body is at rest
constexpr std::int64_t flow_periods = 8;                // until a body that moves on is taken to flow
constexpr double far = 5;                               // times the displacement of elastic soil
constexpr double courant = 0.9, careful_courant = 0.6;  // where small cells do not bear the first
constexpr int steps_between_looks = 20;

/// Longest period of a body that shears on its bottom, 4 H / c_s [s].
double longest_period(const Case& scene) {
  double low = never, high = -never, slowest = never;
  for (const SoilCase& soil : scene.soils) {
    for (const Point& p : soil.polygon) low = std::min(low, p.y()), high = std::max(high, p.y());
    const double shear = soil.youngs_modulus / (2 * (1 + soil.poissons_ratio));
    slowest = std::min(slowest, std::sqrt(shear * scene.loading.gravity / soil.unit_weight_saturated));
  }
  return 4 * (high - low) / slowest;
}

double divided_angle(double degrees, double factor) {
  constexpr double degree = std::numbers::pi / 180;
  return std::atan(std::tan(degrees * degree) / factor) / degree;
}

void weaken(SoilCase& soil, double factor) {
  StrengthCase& s = soil.strength;
  const double sine = 3 * soil.cam_clay.ratio / (6 + soil.cam_clay.ratio);
  const double weaker = std::sin(std::atan(std::tan(std::asin(sine)) / factor));
  soil.cam_clay.ratio = 6 * weaker / (3 - weaker);
  for (double* strength :
       {&s.cohesion, &s.residual_cohesion, &s.undrained_strength, &s.growth, &s.tensile_strength})
    *strength /= factor;
  for (double* angle : {&s.friction_angle, &s.residual_friction_angle})
    *angle = divided_angle(*angle, factor);
  s.dilation_angle = std::min(s.dilation_angle, s.friction_angle);
}

/// The case as trials compute it: reference frozen (no displacement here is more than a hundredth of the
/// body), adaptive damping, Courant number 0.9 (or 0.6), water and loads as they stand at the case's end. One
/// soil has no spring against zigzag, unless the case asks for it: particles beside those that yield hold
/// them by it, and trials take up to twice the steps. Without it weak seams of one or two rows slide too
/// late.
Case trial_of(const Case& scene) {
  Case c = scene;
  c.water = at_rest_from(c.water, c.time.end);
  c.loading.adaptive_damping = true, c.loading.damping = 0, c.loading.damping_until = never;
  c.formulation.refresh_strain = never;
  if (c.soils.size() == 1 && c.formulation.zero_energy_stiffness < 0) c.formulation.zero_energy_stiffness = 0;
  c.time = {.end = longest_rest(scene), .courant = courant};
  c.stop = {.unbalanced_force_ratio = 0, .on_separation = false};
  c.probes.clear();
  for (LoadCase& load : c.loads) load = at_rest_from(load, scene.time.end);
  for (FootingCase& footing : c.footings) footing = at_rest_from(footing, scene.time.end);
  return c;
}

Case elastic(Case scene) {
  for (SoilCase& soil : scene.soils) soil.law = LawKind::elastic;
  return scene;
}

struct FinishedTrial {
  StrengthTrial trial;
  std::unique_ptr<Simulation> simulation;
};

/// Whether a body still moves as fast as before: kinetic energies at equal intervals since a trial began. On
/// its way to rest a body loses them; one that flows has the same in the last quarter as in the one before.
bool keeps_moving(std::span<const double> energies) {
  constexpr double as_fast = 0.95;
  const std::size_t quarter = energies.size() / 4;
  const auto last = energies.last(quarter), before = energies.first(energies.size() - quarter).last(quarter);
  return std::accumulate(last.begin(), last.end(), 0.0) >=
         as_fast * std::accumulate(before.begin(), before.end(), 0.0);
}

/// Advances until it is known how the trial ends, beginning with the state that the simulation is in.
StrengthTrial advance_to_end(Simulation& simulation, double factor, double at_rest,
                             const std::function<bool()>& interrupted) {
  StrengthTrial t{.factor = factor, .end = TrialEnd::not_at_rest};
  const std::int64_t begun = simulation.step(), most = simulation.last_step();
  const double moved_before = simulation.largest_displacement();
  std::vector<double> energies;
  while (simulation.step() < begun + most) {
    simulation.advance();
    if (simulation.instability()) {
      t.end = TrialEnd::broke_down;
      break;
    }
    const std::int64_t steps = simulation.step() - begun;
    if (steps % steps_between_looks != 0) continue;
    if (interrupted && interrupted()) break;
    const double moved = simulation.largest_displacement();
    const Particles& p = simulation.model().particles;
    energies.push_back(kinetic_energy(p, p.velocity));
    if (moved > far * at_rest) {
      t.end = TrialEnd::moved_far;
      break;
    }
    if (simulation.unbalanced_force_ratio() < balanced) {
      t.end = TrialEnd::at_rest;
      break;
    }
    if (moved - moved_before > at_rest && steps > most * flow_periods / most_periods &&
        keeps_moving(energies)) {
      t.end = TrialEnd::flows;
      break;
    }
  }
  t.displacement = simulation.largest_displacement();
  t.unbalanced = simulation.unbalanced_force_ratio();
  t.steps = simulation.step() - begun;
  return t;
}

struct Rest {
  double factor = 0;
  std::shared_ptr<const KeptState> state;
};

class Search {
 public:
  Search(const Case& scene, const StrengthReductionOptions& options)
      : trial_(trial_of(scene)), options_(options) {}

  StrengthReduction run() {
    measure_rest();
    for (std::vector<double> next = first_factors(); !next.empty() && !stopped(); next = next_factors())
      try_all(next);
    std::sort(result_.trials.begin(), result_.trials.end(),
              [](const auto& a, const auto& b) { return a.factor < b.factor; });
    return std::move(result_);
  }

 private:
  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  /// As trials find the soil; elastic soil is always as drawn.
  Beginning beginning() const {
    return {.state = options_.from, .reset_displacements = options_.from != nullptr};
  }

  /// From a rest with a smaller factor, or else from the beginning.
  FinishedTrial try_factor(double factor, const KeptState* rest) {
    auto simulation = factor == 0 ? std::make_unique<Simulation>(elastic(trial_))
                                  : std::make_unique<Simulation>(trial_, rest ? Beginning{} : beginning());
    if (rest) rest->restore(*simulation);
    if (factor > 0) simulation->reduce_strength(factor);
    const StrengthTrial t =
        advance_to_end(*simulation, factor, factor > 0 ? result_.at_rest : never, options_.interrupted);
    return {t, std::move(simulation)};
  }

  /// What elastic soil does: the measure of "far".
  void measure_rest() {
    StrengthTrial t;
    const auto try_elastic = [&] { t = try_factor(0, nullptr).trial; };
    in_parallel({try_elastic});
    if (t.end == TrialEnd::broke_down) {
      trial_.time.courant = careful_courant;
      in_parallel({try_elastic});
    }
    if (stopped()) return;
    if (!t.stable())
      throw std::runtime_error("strength reduction: the body does not come to rest even where it is elastic");
    result_.at_rest = t.displacement;
    if (options_.from == nullptr) return;
    const Simulation before(trial_, beginning());
    for (const HistoryField& h : before.model().particles.history)
      if (h.field.name == law_fields::plastic_strain.name) result_.strain_before = h.values;
  }

  std::vector<double> first_factors() const {
    const auto allowed = [&](double f) { return std::clamp(f, options_.least, options_.most); };
    return {0.97 * allowed(std::min(options_.first_guess, options_.lower_guess)),
            1.03 * allowed(options_.first_guess)};
  }

  /// As many as there are jobs, between the bracket's ends or beyond its open one; none when it is narrow.
  std::vector<double> next_factors() const {
    const double low = result_.stable_at, high = result_.fails_at;
    std::vector<double> next;
    const int jobs = std::max(1, options_.jobs);
    if (high == never) {
      for (int i = 1; i <= jobs; ++i) next.push_back(low * std::pow(1.05, i));
    } else if (low == 0) {
      for (int i = 1; i <= jobs; ++i) next.push_back(high * std::pow(0.95, i));
    } else if (high - low > options_.bracket * (1 + 1e-9)) {
      // No closer together than the bracket that is asked for.
      const int parts =
          std::min(jobs + 1, static_cast<int>(std::ceil((high - low) / options_.bracket - 1e-9)));
      for (int i = 1; i < parts; ++i) next.push_back(low + (high - low) * i / parts);
    }
    return wanted(next);
  }

  /// Those that are inside the limits and inside the bracket.
  std::vector<double> wanted(std::vector<double> factors) const {
    std::erase_if(factors, [&](double f) {
      return f < options_.least || f > options_.most || f <= result_.stable_at || f >= result_.fails_at;
    });
    return factors;
  }

  /// All from the rest that there is when the first begins, so that results do not depend on which ends
  /// first.
  void try_all(const std::vector<double>& factors) {
    const Rest rest = rest_;
    std::vector<std::function<void()>> work;
    for (const double factor : factors)
      work.push_back([this, factor, &rest] {
        keep(try_factor(factor, rest.factor < factor ? rest.state.get() : nullptr));
      });
    in_parallel(work);
  }

  void keep(FinishedTrial finished) {
    if (stopped()) return;
    const std::scoped_lock lock(mutex_);
    const StrengthTrial& t = finished.trial;
    if (t.stable() && t.factor > result_.stable_at && t.factor < result_.fails_at)
      rest_ = {t.factor, std::make_shared<KeptState>(*finished.simulation)};
    if (!t.stable() && t.factor < result_.fails_at) {
      result_.fails_at = t.factor;
      result_.mechanism = std::move(finished.simulation);
    }
    result_.trials.push_back(t);
    // A rest above a failure does not count.
    result_.stable_at = 0;
    for (const StrengthTrial& other : result_.trials)
      if (other.stable() && other.factor < result_.fails_at)
        result_.stable_at = std::max(result_.stable_at, other.factor);
    if (options_.finished) options_.finished(t);
  }

  /// Each on one core, as many at a time as there are jobs.
  void in_parallel(const std::vector<std::function<void()>>& work) {
    std::size_t next = 0;
    std::exception_ptr failure;
    const auto worker = [&] {
      omp_set_num_threads(1);  // of this thread only
      while (true) {
        std::size_t mine;
        {
          const std::scoped_lock lock(queue_);
          if (next >= work.size()) return;
          mine = next++;
        }
        try {
          work[mine]();
        } catch (...) {
          const std::scoped_lock lock(queue_);
          failure = std::current_exception();
          next = work.size();
        }
      }
    };
    std::vector<std::thread> workers;
    for (int i = 0; i < std::min<int>(std::max(1, options_.jobs), static_cast<int>(work.size())); ++i)
      workers.emplace_back(worker);
    for (std::thread& thread : workers) thread.join();
    if (failure) std::rethrow_exception(failure);
  }

  Case trial_;
  const StrengthReductionOptions& options_;
  StrengthReduction result_;
  Rest rest_;  ///< that with the largest factor; none in the beginning
  std::mutex mutex_, queue_;
};

}  // namespace

Case weakened(const Case& scene, double factor) {
  Case c = scene;
  for (SoilCase& soil : c.soils)
    if (soil.law != LawKind::elastic) weaken(soil, factor);
  return c;
}

double longest_rest(const Case& scene) { return static_cast<double>(most_periods) * longest_period(scene); }

StrengthReduction reduce_strength(const Case& scene, const StrengthReductionOptions& options) {
  if (const std::string obstacle = safety_obstacle(scene); !obstacle.empty())
    throw std::runtime_error("strength reduction: " + obstacle);
  return Search(scene, options).run();
}

}  // namespace porosph
