// The work of a force that is too costly to sum in every step.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/particles/particles.hpp"
#include "solver/space/parallel.hpp"

namespace porosph {

/// In one of some steps: what a force accelerates, with the velocities before; its work over that step then
/// stands for all of them.
struct ForceSample {
  static constexpr int steps_between = 16;

  std::vector<Vec2> acceleration, velocity;  ///< [m/s2], [m/s]; empty where none is due
  std::int64_t steps = 0;                    ///< counted so far

  bool due() const { return steps % steps_between == 0; }
  /// Makes room for the sums of a step in which one is due.
  void begin(const Particles& p) { acceleration.assign(p.size(), Vec2::Zero()), velocity = p.velocity; }
  /// Energy that the force takes over the step dt [s] that has led to the velocities now, and those that this
  /// one stands for; 0 where none was due [J/m].
  double taken(const Particles& p, double dt) {
    ++steps;
    if (acceleration.empty()) return 0;
    return -steps_between * dt * deterministic_sum(p.size(), [&](std::size_t a) {
      return 0.5 * p.mass[a] * acceleration[a].dot(velocity[a] + p.velocity[a]);
    });
  }
};

}  // namespace porosph
