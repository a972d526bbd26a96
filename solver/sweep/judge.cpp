#include "solver/sweep/judge.hpp"

#include <cmath>

#include "solver/run/energy_budget.hpp"
#include "solver/run/reference_errors.hpp"
#include "solver/run/run.hpp"

namespace porosph {
namespace {

const double none = std::nan("");

StabilityClass class_of(const RunOutcome& outcome, const Simulation& s, const Verdict& v,
                        const SweepLimits& limits) {
  if (outcome.status == RunStatus::unstable)
    return s.instability()->cause == Cause::separated ? StabilityClass::thrown_out : StabilityClass::unstable;
  if (!(v.unbalanced <= limits.settled)) return StabilityClass::not_settled;
  return v.error <= limits.accurate ? StabilityClass::accurate : StabilityClass::inaccurate;
}

}  // namespace

double vertical_stress_error(const Simulation& s, const std::function<double(const Vec2&)>& exact) {
  const Particles& p = s.model().particles;
  double difference = 0, reference = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double wanted = exact(p.start[i]);
    if (!std::isfinite(wanted)) continue;
    const double d = p.stress[i].yy - wanted;
    difference += p.volume(i) * d * d, reference += p.volume(i) * wanted * wanted;
  }
  return std::sqrt(difference / reference);
}

ErrorMeasure exact_measure(const Case& scene) {
  if (scene.reference == Reference::none)
    throw std::runtime_error("the case names no reference: give it one, or choose weight_above or fem");
  return [](const Simulation& s) { return reference_errors(s).at("EffectiveStress_YY").relative_l2; };
}

ErrorMeasure weight_measure(const Case& scene) {
  if (!scene.loading.gravity_applied) throw std::runtime_error("weight_above needs gravity");
  Case at_end = scene;
  at_end.water = at_rest_from(scene.water, scene.time.end);
  return [scene = at_end](const Simulation& s) {
    return vertical_stress_error(s, [&](const Vec2& x) { return k0_stress(scene, x, 0).yy; });
  };
}

ErrorMeasure energy_measure(const Case& scene) {
  const double at_start = Simulation(scene).energy().total();
  return [at_start](Simulation& s) {
    const auto e = energy_budget(s, at_start);
    if (!e || !(e->released > 0)) return none;
    return (std::abs(e->control) + std::abs(e->diffusion) + std::abs(e->bulk_viscosity) +
            std::abs(e->unaccounted)) /
           e->released;
  };
}

Verdict judge(const Case& scene, const SweepLimits& limits, const MeasureMaker& measure,
              const std::function<bool()>& interrupted) {
  const ErrorMeasure error = measure(scene);
  Simulation s(scene);
  const RunOutcome outcome = run(s, {.frame = {}, .history = {}, .progress = {}, .interrupted = interrupted});
  const bool broken = outcome.status == RunStatus::unstable;
  Verdict v{.outcome = {},
            .cause = broken ? std::string(cause_name(s.instability()->cause)) : "",
            .time = s.time(),
            .steps = s.step(),
            .error = broken ? none : error(s),
            .unbalanced = broken ? none : s.unbalanced_force_ratio(),
            .energy_growth = outcome.energy_growth,
            .message = broken ? outcome.message : ""};
  v.outcome = class_of(outcome, s, v, limits);
  return v;
}

}  // namespace porosph
