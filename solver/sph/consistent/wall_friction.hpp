// Friction between soil and walls: elastic until it slips, then in proportion to the pressure on the wall.
#pragma once

#include <vector>

#include "solver/particles/state.hpp"
#include "solver/sph/consistent/force_sample.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// The time in which friction follows the pressure [s].
double friction_memory(const Model& model);

/// The row of particles at a wall drags it along a spring of stiffness G / h, whose stress slips at the
/// coefficient times the normal effective stress at the wall. Ghosts behind it, which a frictionless wall
/// gives the opposite shear stress of the soil, get that and twice the spring's: the mean on the wall is the
/// spring's. Inactive where no wall has friction.
class WallFriction {
 public:
  WallFriction() = default;
  explicit WallFriction(const Model& model);

  bool active() const { return !walls_.empty(); }

  /// Finds the particles at the walls, for a new reference.
  void take(const ReferenceConfiguration& reference, const Model& model);
  /// Carries the springs over a step dt [s] with the velocities of its middle.
  void slide(const Model& model, double dt);
  /// Adds the walls' shear to the ghosts' first Piola-Kirchhoff stress, once that is the frictionless walls',
  /// and keeps the normal stress there for the next step. `piola`: particles, then ghosts [Pa].
  void apply(const ReferenceConfiguration& reference, PlaneTensors& piola);

  /// The work of friction is counted in one of some steps, for all of them: what it accelerates, with the
  /// velocities before, when forces have been summed ...
  void sample(const ReferenceConfiguration& reference, const Particles& particles);
  /// ... and its work once these have changed the velocities, over a step dt [s].
  void count(const Particles& particles, double dt);
  double work() const { return work_; }  ///< that walls have so taken [J/m]

  void visit(StateArchive& state);

 private:
  /// Of one wall with friction; arrays are of all particles.
  struct AtWall {
    std::int32_t wall;
    std::vector<double> shear;        ///< of the spring, on the soil's face towards the wall, along `to` [Pa]
    std::vector<double> pressure;     ///< normal on the wall, effective [Pa]
    std::vector<double> lagging;      ///< the same as friction follows it [Pa]
    std::vector<std::int32_t> near;   ///< the particles with images in it
    std::vector<std::int32_t> row;    ///< those next to it, along it
    std::vector<std::size_t> ghosts;  ///< behind it
  };
  double mobilised_beside(const AtWall& at, const ReferenceConfiguration& reference, const Wall& wall,
                          std::int32_t particle) const;

  std::vector<AtWall> walls_;
  double spacing_ = 0, smoothing_length_ = 0;
  double memory_ = 1;               ///< time in which friction follows the pressure [s]
  std::vector<PlaneTensor> added_;  ///< to the stress of each ghost [Pa]
  ForceSample sample_;
  double work_ = 0;
};

}  // namespace porosph
