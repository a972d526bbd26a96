// Inertia that makes all soils equally fast on the way to rest, and leaves stiff bodies the mass they move
// with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"

namespace porosph {

/// Each soil has s times its mass as inertia, by inertia_over_mass(): the waves of all soils are then equally
/// fast, and the time step is as long as the softest soil allows. What is slow then is a stiff body that
/// rides on softer soil. So such a body moves as a whole (the two translations and the rotation that walls
/// leave free) with its mass times that s which the stiffest soil around it has, 1 where it is free:
///
///   v' = a / s + sum over bodies (1 / s_around - 1 / s_body) R a,
///
/// a the acceleration of the true masses under the same forces, R a the rigid motion of the body nearest to
/// it, weighted by mass. A body is all soil of at least its s that hangs together; bodies lie in bodies of
/// less s, whose terms add up. This is the inverse of the symmetric positive definite inertia
///
///   m s - sum over bodies (s_body - s_around) m R.
///
/// Forces, and so the state of rest, are those of the true masses. The zero-energy control does not grow with
/// the inertia, but holds what the stress behind walls would make grow in stiff soil. So stiff soil is damped
/// in proportion to its stiffness: K v is what a step changes of its accelerations.
class ScaledInertia {
 public:
  ScaledInertia() = default;
  /// Of the particles as drawn, with their present masses.
  ScaledInertia(const Case& scene, const Model& model);

  bool acts() const { return !mass_.empty(); }
  /// Turns accelerations of the true masses into those of the scaled inertia, particle by particle [m/s2].
  /// Does nothing where it does not act.
  void scale(std::span<Vec2> accelerations) const;
  /// Those that the next step takes, from those of the true masses at its start, once per step: scaled, and
  /// damped in stiff soil. They are valid until the next call.
  std::span<const Vec2> take_step(std::span<const Vec2> by_mass);
  /// Saves or restores what it keeps from step to step.
  void visit(StateArchive& state);
  /// v . (inertia) v / 2 of the particles' velocities [J/m]. Where it acts only.
  double kinetic_energy(std::span<const Vec2> velocities) const;
  std::size_t bodies() const { return bodies_.size(); }  ///< that may move as a whole

 private:
  /// Of a body: its centre's motion and, per radian, the rotation about it.
  struct Rigid {
    Vec2 centre = Vec2::Zero();
    double turn = 0;
  };
  struct Body {
    std::vector<std::int32_t> particles;
    double own = 1, around = 1;    ///< s of its softest soil, and of the stiffest that it rides on
    double mass = 0, moment = 0;   ///< [kg/m], [kg m]; no moment: it does not turn
    Vec2 centre = Vec2::Zero();    ///< of mass [m]
    Mat2 free = Mat2::Identity();  ///< onto the translations that walls leave it
  };
  class Finder;

  /// R of a field of all particles.
  Rigid nearest(const Body& body, std::span<const Vec2> field) const;
  Vec2 arm(const Body& body, std::int32_t particle) const;  ///< velocity per turn [m]

  std::vector<double> mass_, inertia_;  ///< of each particle: m [kg/m], and s
  std::vector<Vec2> place_;             ///< as drawn [m]
  std::vector<Body> bodies_;
  std::vector<Vec2> before_, next_;  ///< accelerations: by mass, of the last step; of the next step [m/s2]
};

}  // namespace porosph
