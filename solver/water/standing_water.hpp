// Water that stands, outside the soil and in its pores: levels and hydrostatic pressure.
#pragma once

#include <algorithm>

#include "solver/case/case.hpp"

namespace porosph {

/// Level of water that moves, at a time [s]: y [m].
inline double level_at(const WaterCase& water, double time) {
  const auto& steps = water.level_over_time;
  const auto next = std::find_if(steps.begin(), steps.end(), [&](const Point& p) { return p.x() > time; });
  if (next == steps.begin()) return next->y();
  const Point before = *(next - 1);
  if (next == steps.end()) return before.y();
  return before.y() + (next->y() - before.y()) * (time - before.x()) / (next->x() - before.x());
}

/// The water as it stands at a time [s].
inline WaterCase at_rest_from(WaterCase water, double time) {
  if (water.level_over_time.empty()) return water;
  water.stretches = {{-never, never, level_at(water, time)}};
  water.level_over_time.clear();
  return water;
}

/// The stretch over x, the first if two meet there; -1 where there is none.
inline int stretch_at(const std::vector<WaterStretch>& stretches, double x) {
  const auto over = [x](const WaterStretch& s) { return x >= s.x_from && x <= s.x_to; };
  const auto found = std::find_if(stretches.begin(), stretches.end(), over);
  return found == stretches.end() ? -1 : static_cast<int>(found - stretches.begin());
}

/// Hydrostatic water, level per stretch of x.
class StandingWater {
 public:
  StandingWater() = default;
  explicit StandingWater(const WaterCase& water) : water_(water), stretches_(water.stretches) {}

  /// Moves the level to where it is at this time [s].
  void set_time(double time) {
    if (!water_.level_over_time.empty()) stretches_[0].level = level_at(water_, time);
  }

  bool present() const { return !stretches_.empty(); }
  double unit_weight() const { return water_.unit_weight; }                  ///< gamma_w [N/m3]
  const std::vector<WaterStretch>& stretches() const { return stretches_; }  ///< levels as they are now

  /// Height of the water level at x above y; negative or -never where the point is dry [m].
  double depth(double x, double y) const {
    for (const WaterStretch& s : stretches_)
      if (x >= s.x_from && x <= s.x_to) return s.level - y;
    return -never;
  }

  /// The stretch over x, -1 where there is none.
  int stretch_at(double x) const { return porosph::stretch_at(stretches_, x); }
  /// p_w at a height y under a stretch at a time [s], 0 above its level and without one [Pa].
  double pore_pressure_under(int stretch, double y, double time) const {
    if (stretch < 0) return 0;
    const double level = water_.level_over_time.empty() ? stretches_[stretch].level : level_at(water_, time);
    return -water_.unit_weight * std::max(0.0, level - y);
  }

  /// p_w, negative in compression, zero above the level (eq. 12) [Pa].
  double pore_pressure(double x, double y) const { return -water_.unit_weight * std::max(0.0, depth(x, y)); }

 private:
  WaterCase water_;
  std::vector<WaterStretch> stretches_;
};

}  // namespace porosph
