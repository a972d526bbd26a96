#include "solver/run/monitor/breakdown_watch.hpp"

#include <algorithm>

namespace porosph {

BreakdownWatch::BreakdownWatch(const Case& scene, const Model& model)
    : closest_(closest_distance(model.particles.position, 2 * model.spacing)),
      may_part_(!scene.stop.on_separation),
      is_conventional_(scene.formulation.motion == Motion::conventional) {
  if (!may_part_) bodies_ = find_bodies(model.particles.position, 2 * model.smoothing_length).count;
}

void BreakdownWatch::look(const Model& model, double time) {
  constexpr double met = 0.25;                                        // of the smallest distance at the start
  const bool flows = std::ranges::any_of(model.soils, &Soil::flows);  // particles keep meeting new ones
  if (!found_ && !flows) found_ = find_crossing(model, met * closest_, time);
  if (!found_) found_ = find_too_stiff(model, time);
  if (!found_) found_ = find_beyond_wall(model, time);
  if (!found_ && !may_part_) found_ = find_separation(model, bodies_, time);
}

void BreakdownWatch::after_step(std::int64_t runaways, const Model& model, double time) {
  ran_away_ = runaways > 0;
  if (ran_away_) name_runaway(model, time);
}

/// What the conventional form throws off is fast in the end, but that it left is what went wrong first.
void BreakdownWatch::name_runaway(const Model& model, double time) {
  found_ = find_runaway(model, time);
  if (!is_conventional_ || may_part_ || found_->cause != Cause::too_fast) return;
  if (!std::ranges::all_of(model.particles.position, [](const Vec2& x) { return x.allFinite(); })) return;
  if (auto separation = find_separation(model, bodies_, time)) found_ = std::move(separation);
}

}  // namespace porosph
