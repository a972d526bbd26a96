// What the consistent form computes with since its reference: deformation, fluxes, and what the sums read of
// particles and ghosts.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/particles/state.hpp"
#include "solver/space/zero_pages.hpp"
#include "solver/sph/consistent/along_interfaces.hpp"
#include "solver/sph/consistent/reference.hpp"
#include "solver/sph/consistent/stress_behind_walls.hpp"
#include "solver/sph/consistent/wall_friction.hpp"
#include "solver/sph/consistent/zero_energy_spring.hpp"
#include "solver/sph/kernels/record.hpp"

namespace porosph {

/// Arrays are of the particles, then the ghosts, where no other is said.
class Fluxes {
 public:
  Fluxes() = default;
  /// Undeformed. `elastic_control`: the zero-energy control acts on displacements as well. `loose`: where
  /// soil flows, particles that bear no stress. `room`: records of earlier fluxes, or none.
  Fluxes(const ReferenceConfiguration& reference, const Model& model, bool elastic_control,
         const LooseParticles* loose, SparselyWritten<Record> room);

  /// For take_pressures_alone().
  static Fluxes of_pressures(const ReferenceConfiguration& reference);

  /// Velocities of the particles, and the ghosts'.
  template <Mirrors how>
  void take_velocities(const ReferenceConfiguration& reference, std::span<const Vec2> velocities);
  /// What the next forces need beside the flux of the particles: pore pressure, v + k * displacement for the
  /// zero-energy control, and the ghosts' P and flux.
  /// `flow`: viscosity of the control of each particle, which grows by the ghosts'; or null.
  void prepare_forces(const ReferenceConfiguration& reference, const Model& model,
                      const ZeroEnergySpring& spring, std::vector<double>* flow, WallFriction& friction);

  /// In place of both: fluxes of pressures `excess` of the particles alone [Pa], where `soil` has deformed.
  /// All walls mirror them, so that their force is the adjoint of the rate of volume.
  void take_pressures_alone(const ReferenceConfiguration& reference, const std::vector<double>& fill,
                            const Fluxes& soil, std::span<const double> excess);

  const AlongInterfaces& along_interfaces() const { return along_interfaces_; }
  /// Adds their part to the accelerations [m/s2], after prepare_forces().
  void add_along_interfaces(const ReferenceConfiguration& reference, const Particles& particles,
                            std::span<Vec2> accelerations) {
    along_interfaces_.add_forces(reference, piola_, particles.fill, accelerations);
  }

  Mat2 deformation(std::size_t a) const { return deformation_[a]; }  ///< F of a particle

  PlaneTensors& deformation() { return deformation_; }
  PlaneTensors& flux() { return flux_; }
  std::span<Record> records() { return records_; }
  SparselyWritten<Record> give_records() { return std::move(records_); }  ///< which are then gone
  void keep_piola_of(std::span<const std::int32_t> particles) {
    for (const std::int32_t a : particles) mirrored_[a] = 1;
  }
  const PlaneTensors& piola() const { return piola_; }  ///< of what is mirrored, and of the ghosts

  void connect(ConsistentArrays& arrays, const ReferenceConfiguration& reference);
  /// Saves or restores what the next step needs; ghosts have theirs made when they are needed.
  void visit(StateArchive& state, const ReferenceConfiguration& reference);

 private:
  template <Mirrors how, class Of>
  void spread(const ReferenceConfiguration& reference, std::array<std::vector<double>, 2>& field,
              Of&& of_particle);
  void take_pressures(const ReferenceConfiguration& reference, const Model& model);
  void take_viscosities(const ReferenceConfiguration& reference, std::vector<double>& viscosity);
  void set_flux(const ReferenceConfiguration& reference, std::size_t of, const Mat2& flux);
  void fill_ghost_fluxes(const ReferenceConfiguration& reference, const std::vector<double>& fill,
                         bool fixed_walls_are_seen);

  PlaneTensors deformation_;                       ///< F, of the particles
  PlaneTensors flux_;                              ///< fill P L - mu (dF/dt + rate (F - I)) [Pa]
  std::vector<double> pressure_;                   ///< p_w [Pa]; empty in dry soil
  std::array<std::vector<double>, 2> velocity_;    ///< [m/s]
  std::array<std::vector<double>, 2> controlled_;  ///< v + rate * displacement [m/s]; empty without
  SparselyWritten<Record> records_;                ///< flux, p_w and velocity of those that are listed
  std::vector<std::uint8_t> mirrored_;             ///< of the particles: their P is asked for
  PlaneTensors piola_;                             ///< P of those, and of the ghosts [Pa]
  std::vector<Vec2> ghost_positions_;              ///< where the ghosts are now [m]
  StressBehindWalls behind_walls_;
  AlongInterfaces along_interfaces_;
};

}  // namespace porosph
