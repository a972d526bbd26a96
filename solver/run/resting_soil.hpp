// Soil that is at rest all the while, under loads and pore pressures that change slowly.
#pragma once

#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/run/relaxation.hpp"
#include "solver/run/surface_forces.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {

/// Dynamic relaxation under the effective stress and the excess pressure p_e, which act as one stress:
/// P = J (sigma' + p_e I) F^-T. The soil's own velocity carries over from one call to the next.
class RestingSoil {
 public:
  /// `dt` of the relaxation [s].
  RestingSoil(Model& model, Dynamics& dynamics, SurfaceForces& surface, double dt);

  std::span<double> excess() { return excess_; }  ///< p_e of the particles [Pa]
  /// So many steps under the loads and footings of a time [s]; `accelerations` are then those that are left.
  void relax(int sweeps, double time);
  /// Moves the particles at once to where they are thought to come to rest, from where they are at rest.
  void move_to(std::span<const Vec2> places);
  /// Steps in which a wave crosses the body.
  int crossing() const;

  /// RMS of the forces per volume, times the extent of the body [Pa].
  double out_of_balance() const;
  /// Volume that each particle has gained [m2].
  double volume_gained(std::size_t a) const { return model_.particles.volume(a) - start_volume_[a]; }
  double start_volume(std::size_t a) const { return start_volume_[a]; }
  std::size_t fastest() const;  ///< the particle
  std::span<const Vec2> accelerations() const { return accelerations_; }
  std::int64_t sweeps() const { return sweeps_; }  ///< so far
  void visit(StateArchive& state);

 private:
  void prepare();

  Model& model_;
  Dynamics& dynamics_;
  SurfaceForces& surface_;
  double dt_;
  double extent_;  ///< of the body [m]
  Relaxation relaxation_;
  std::vector<double> excess_, start_volume_;
  std::vector<Vec2> accelerations_, before_;
  std::int64_t sweeps_ = 0;
};

}  // namespace porosph
