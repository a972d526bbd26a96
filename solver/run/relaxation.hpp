// Adaptive dynamic relaxation: as much damping as brings the motion at hand to rest soonest.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "solver/particles/particles.hpp"
#include "solver/particles/state.hpp"

namespace porosph {

/// Critical damping c_d = 2 omega of the lowest vibration that the motion contains (Underwood 1983; Oakley
/// and Knight 1995). Its frequency is the Rayleigh quotient of the motion itself,
///
///   omega^2 = v . K v / v . M v,      K v dt = M (a before - a after) of a step,
///
/// both parts averaged over the last 1 / omega. It lies between the lowest and the highest frequency that
/// are excited, and falls to the lowest as the others, which it damps less than critically, die out.
///
/// These three numbers are all that a run that continues later needs to know.
struct Relaxation {
  double stiffness = 0;  ///< mean of v . K v [W/m/s]
  double inertia = 0;    ///< mean of v . M v [J/m]
  double damping = 0;    ///< c_d, at most 1 / dt; 0 before the first measurement [1/s]

  static constexpr int steps_between = 5;  ///< measurements; the means change more slowly

  /// From the accelerations of the true masses at both ends of a step dt [s] and the velocities in it. A body
  /// at rest, or one that softens as it moves, changes nothing. `inertia`: v . M v [J/m], where M is not the
  /// masses.
  void measure(const Particles& particles, std::span<const Vec2> before, std::span<const Vec2> after,
               double dt, std::optional<double> inertia = {});
  /// Saves or restores them, under names that begin so.
  void visit(StateArchive& state, std::string_view name);
};

}  // namespace porosph
