// How a simulation counts time: in steps of its own, or in the ticks of a flow that chooses its steps.
#pragma once

#include <cstdint>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"

namespace porosph {

struct Clock {
  double start = 0;                      ///< 0, but in later stages [s]
  double courant = 0;                    ///< the case's, or less where single particles require it
  double dt = 0;                         ///< that steps are counted by [s]
  std::int64_t step = 0, last_step = 0;  ///< the last one reaches the case's end time
  std::int64_t ticks = 1;                ///< of dt that the next step takes
  std::int64_t moves = 0;                ///< steps with inertia so far, where dt is a tick of the flow

  double at(std::int64_t k) const { return start + static_cast<double>(k) * dt; }  ///< [s]
  double now() const { return at(step); }
  double then() const { return at(step + ticks); }                        ///< after the next step [s]
  double step_length() const { return dt * static_cast<double>(ticks); }  ///< of the next [s]
  bool ended() const { return step >= last_step; }
  void go_on() { step += ticks, ++moves; }

  /// From now on dt is a tick so short that steps of any length up to `end` [s] end on one, and a step of
  /// `shortest` [s] takes many.
  void count_ticks_until(double end, double shortest);
  /// Takes the time that a flow reached on its way to the tick `due`.
  void reach(double time, std::int64_t due);
  /// The next tick at which the case writes something, as Schedule counts it.
  std::int64_t next_due(const OutputCase& output) const;
};

/// Throws std::runtime_error where the case's own time step is too long.
Clock make_clock(const Case& scene, const Model& model, double start);

}  // namespace porosph
