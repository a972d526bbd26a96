#include "solver/run/strength_reduction.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "solver/boundary/traction.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph {
namespace {

constexpr double balanced = 1e-4;    // unbalanced force ratio at rest
constexpr double most_periods = 40;  // until a body is at rest
constexpr double far = 5;            // times the displacement at rest
constexpr double courant = 0.6;
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
  if (factor > 0) soil.cam_clay.ratio = 6 * weaker / (3 - weaker);
  if (factor == 0) {
    soil.law = LawKind::elastic;
    return;
  }
  for (double* strength :
       {&s.cohesion, &s.residual_cohesion, &s.undrained_strength, &s.growth, &s.tensile_strength})
    *strength /= factor;
  for (double* angle : {&s.friction_angle, &s.residual_friction_angle})
    *angle = divided_angle(*angle, factor);
  s.dilation_angle = std::min(s.dilation_angle, s.friction_angle);
}

double largest_displacement(const Particles& p) {
  double squared = 0;
  for (std::size_t i = 0; i < p.size(); ++i) squared = std::max(squared, p.displacement(i).squaredNorm());
  return std::sqrt(squared);
}

struct FinishedTrial {
  StrengthTrial trial;
  std::unique_ptr<Simulation> simulation;
};

FinishedTrial try_factor(const Case& scene, double factor, double most_displacement,
                         const std::function<bool()>& interrupted) {
  auto simulation = std::make_unique<Simulation>(weakened(scene, factor));
  StrengthTrial t{.factor = factor, .end = TrialEnd::not_at_rest};
  while (simulation->step() < simulation->last_step()) {
    simulation->advance();
    if (simulation->instability()) {
      t.end = TrialEnd::broke_down;
      break;
    }
    if (simulation->step() % steps_between_looks != 0) continue;
    if (interrupted && interrupted()) break;
    t.displacement = largest_displacement(simulation->model().particles);
    if (t.displacement > most_displacement) {
      t.end = TrialEnd::moved_far;
      break;
    }
    t.unbalanced = simulation->unbalanced_force_ratio();
    if (t.unbalanced < balanced) {
      t.end = TrialEnd::at_rest;
      break;
    }
  }
  t.displacement = largest_displacement(simulation->model().particles);
  t.unbalanced = simulation->unbalanced_force_ratio();
  t.steps = simulation->step();
  return {t, std::move(simulation)};
}

class Search {
 public:
  Search(const Case& scene, const StrengthReductionOptions& options) : scene_(scene), options_(options) {}

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

  /// What the body does without division: the measure of "far". Elastic where it fails even so.
  void measure_rest() {
    double height = never;
    for (const SoilCase& soil : scene_.soils)
      for (const Point& p : soil.polygon) height = std::min(height, p.y());
    FinishedTrial elastic, whole;
    in_parallel({[&] { elastic = try_factor(scene_, 0, never, options_.interrupted); },
                 [&] { whole = try_factor(scene_, 1, never, options_.interrupted); }});
    if (stopped()) return;
    if (!elastic.trial.stable())
      throw std::runtime_error("strength reduction: the body does not come to rest even where it is elastic");
    const bool rests = whole.trial.stable() && whole.trial.displacement <= far * elastic.trial.displacement;
    if (!rests && whole.trial.stable()) whole.trial.end = TrialEnd::moved_far;
    result_.at_rest = rests ? whole.trial.displacement : elastic.trial.displacement;
    keep(std::move(whole));
  }

  std::vector<double> first_factors() const {
    const double guess = std::clamp(options_.first_guess, options_.least, options_.most);
    const std::vector<double> around = wanted({0.97 * guess, 1.03 * guess});
    return around.empty() ? next_factors() : around;  // the trial at 1 may have shown the guess to be wrong
  }

  /// As many as there are jobs, between the bracket's ends or beyond its open one; none when it is narrow.
  std::vector<double> next_factors() const {
    const double low = result_.stable_at, high = result_.fails_at;
    std::vector<double> next;
    const int jobs = std::max(1, options_.jobs);
    if (high == never) {
      for (int i = 1; i <= jobs; ++i) next.push_back(low * std::pow(1.1, i));
    } else if (low == 0) {
      for (int i = 1; i <= jobs; ++i) next.push_back(high * std::pow(0.9, i));
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

  void try_all(const std::vector<double>& factors) {
    std::vector<std::function<void()>> work;
    for (const double factor : factors)
      work.push_back(
          [this, factor] { keep(try_factor(scene_, factor, far * result_.at_rest, options_.interrupted)); });
    in_parallel(work);
  }

  void keep(FinishedTrial finished) {
    if (stopped()) return;
    const std::scoped_lock lock(mutex_);
    const StrengthTrial& t = finished.trial;
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

  const Case& scene_;
  const StrengthReductionOptions& options_;
  StrengthReduction result_;
  std::mutex mutex_, queue_;
};

}  // namespace

Case weakened(const Case& scene, double factor) {
  Case c = scene;
  for (SoilCase& soil : c.soils)
    if (soil.law != LawKind::elastic) weaken(soil, factor);
  c.water = at_rest_from(c.water, c.time.end);
  c.loading.adaptive_damping = true, c.loading.damping = 0, c.loading.damping_until = never;
  c.formulation.refresh_strain = never;
  c.time = {.end = most_periods * longest_period(scene), .courant = courant};
  c.stop = {.unbalanced_force_ratio = 0, .on_separation = false};
  c.probes.clear();
  for (LoadCase& load : c.loads) load = at_rest_from(load, scene.time.end);
  return c;
}

StrengthReduction reduce_strength(const Case& scene, const StrengthReductionOptions& options) {
  if (!scene.loading.gravity_applied)
    throw std::runtime_error("strength reduction: loading.gravity_applied = false: nothing drives the soil");
  if (std::ranges::none_of(scene.soils, [](const SoilCase& soil) { return soil.law != LawKind::elastic; }))
    throw std::runtime_error("strength reduction: no soil yields: give one the key 'law' and a strength");
  return Search(scene, options).run();
}

}  // namespace porosph
