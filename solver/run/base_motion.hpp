// Shaking: the horizontal acceleration of all supports, seen from them.
#pragma once

#include <span>

#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"
#include "solver/particles/state.hpp"
#include "solver/run/leapfrog.hpp"

namespace porosph {

/// Acceleration of the base to the right at a time [m/s2, s].
double base_acceleration(const ShakingCase& shaking, double time);

/// When it is over [s]; never: it does not end.
double end_of_shaking(const ShakingCase& shaking);

/// The equation of motion is that of a frame that moves with the base: -a_b(t) is added to the acceleration
/// of each particle, soil and water alike, and supports stand still. Positions, displacements and velocities
/// are relative to the base, and so is kinetic energy; the work of the base is that of the forces -m a_b.
class BaseMotion {
 public:
  explicit BaseMotion(const ShakingCase& shaking) : shaking_(shaking) {}

  bool acts() const { return shaking_.acts(); }
  double acceleration(double time) const { return base_acceleration(shaking_, time); }
  /// Adds -a_b(t) to the accelerations [m/s2].
  void push(double time, std::span<Vec2> accelerations) const;
  /// Counts the work of the step that begins at `time`, in which `kick` and these accelerations move the
  /// particles.
  void count_work(double time, const Particles& particles, Kick kick, std::span<const Vec2> accelerations);
  double work() const { return work_; }  ///< done on the soil so far [J/m]
  void visit(StateArchive& state);

 private:
  ShakingCase shaking_;
  double work_ = 0;
};

}  // namespace porosph
