// Rigid footings: plates that part of the soil's surface moves with.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/model/model.hpp"
#include "solver/particles/state.hpp"
#include "solver/run/leapfrog.hpp"

namespace porosph {

/// The surface under a plate is cut into strips k, one for each column of particles. A strip moves as the
/// mean of its particles by their shares n_a of the surface, and a force on the strip acts on them in these
/// shares:
///
///   C_k v = sum_a w_ka v_a,     m_a a_a += w_ka lambda_k,     w_ka = n_a / sum n_b
///
/// so force and motion are each other's adjoint, and a uniform stress under the plate is in balance to
/// rounding. The forces lambda are those with which all strips move alike: C M^-1 C^T lambda = what is
/// missing.
class Footing {
 public:
  /// On the ground as drawn. Throws std::runtime_error where no particle is near the stretch.
  Footing(const FootingCase& footing, const Case& scene, const Model& model,
          std::span<const Vec2> surface_vectors);

  /// Adds to the accelerations [m/s2] what the plate does, so that `kick` and a step dt [s] bring the strips
  /// to where the plate is at the time `then` [s], in balance with its force or at its settlement.
  void hold(const Particles& particles, Kick kick, double dt, double then, std::span<Vec2> accelerations);

  /// What it leaves of accelerations [m/s2] that begin from how it holds the strips already: they move alike,
  /// or not at all where it is driven by its settlement.
  void hold_alike(const Particles& particles, std::span<Vec2> accelerations) const;

  /// Puts it on the ground as the particles lie, where it has settled so far [m] already.
  void place(const Particles& particles, double settlement);
  double settlement(const Particles& particles) const;  ///< into the soil, since it was placed [m]
  /// What the soil resists by, per metre of thickness, at the last hold(): the force that keeps the strips
  /// from being accelerated.
  double force() const { return force_; }      ///< against the plate [N/m]
  double shear() const { return shear_; }      ///< along the stretch, towards `to` [N/m]
  double squares() const { return squares_; }  ///< sum of squares of its forces on the particles
  const std::string& name() const { return case_.name; }
  double width() const { return width_; }  ///< of the surface that moves with it [m]
  std::span<const std::int32_t> particles() const { return particles_; }
  void visit(StateArchive& state);  ///< saves or restores where it was placed

 private:
  struct Strip {
    std::size_t first, last;     ///< of particles_
    double compliance;           ///< sum w^2 / m [1/kg]
    Vec2 before = Vec2::Zero();  ///< displacement of the ground when the plate was placed [m]
  };
  Vec2 mean(const Strip& strip, std::span<const Vec2> of_particles) const;
  Vec2 mean_displacement(const Strip& strip, const Particles& particles) const;

  FootingCase case_;
  Vec2 into_ = Vec2::Zero(), along_ = Vec2::Zero();  ///< unit vectors: into the soil, along the stretch
  std::vector<std::int32_t> particles_;              ///< strip by strip
  std::vector<double> weights_;                      ///< w of each
  std::vector<Strip> strips_;
  double width_ = 0, force_ = 0, shear_ = 0, squares_ = 0;
};

/// Of a case. Throws std::runtime_error where no particle is near one, or two share a particle.
std::vector<Footing> make_footings(const Case& scene, const Model& model);

}  // namespace porosph
