// What soil that yields needs in large deformation beyond the sums of elastic soil: see docs/theory.md.
#pragma once

#include <span>
#include <vector>

#include "solver/particles/state.hpp"
#include "solver/sph/consistent/force_sample.hpp"
#include "solver/sph/consistent/loose_particles.hpp"
#include "solver/sph/consistent/reference.hpp"
#include "solver/sph/consistent/rows_at_walls.hpp"
#include "solver/sph/consistent/stress_diffusion.hpp"
#include "solver/sph/consistent/wall_work.hpp"

namespace porosph {

/// Elastic soil has none of it: active() is false where no soil of the case yields.
///
/// The volume of soil that has come apart is not what its deformation says but what its law does, so each
/// new reference takes the density from the stress. Particles that have come too close are moved apart. A
/// part of the stress that alternates from particle to particle is diffused while the soil shears, before
/// the law returns it to its surface. And the zero-energy control is bounded by the strength of the soil.
class FlowingSoil {
 public:
  FlowingSoil() = default;
  FlowingSoil(const Model& model, double control_viscosity);

  bool active() const { return !rest_density_.empty(); }
  bool has_flowed() const { return has_flowed_; }  ///< since the start a reference has been rebuilt

  /// Before a reference is rebuilt: density by the law, and particles moved to even out their arrangement.
  void settle(Model& model, const ReferenceConfiguration& reference);
  /// After that: what sums over the soil alone need.
  void take(const ReferenceConfiguration& reference, const Model& model);

  /// The velocities that what follows is of.
  void take_velocities(const ReferenceConfiguration& reference, const Particles& particles) {
    rows_.take_velocities(reference, particles);
  }
  /// F of particles at fixed walls over a step dt [s], in soil that has flowed only. Returns the largest
  /// |F - I| there.
  double deform_at_walls(double dt, PlaneTensors& deformation) const {
    return has_flowed_ ? rows_.deform(dt, loose_, deformation) : 0;
  }
  /// Diffuses the stress after a step.
  void diffuse_stress(Model& model, const ConsistentKernels& kernels, const ConsistentArrays& arrays) {
    work_.diffusion += diffusion_.apply(model, kernels, arrays);
  }

  /// Next to fixed walls the control sees the soil alone: RowsAtWalls::leave_out().
  void leave_out_walls(const ReferenceConfiguration& reference, PlaneTensors& flux,
                       std::span<Record> records) const {
    rows_.leave_out(reference, viscosity_, flux, records);
  }
  void leave_out_walls(const ReferenceConfiguration& reference, const Particles& particles,
                       std::span<Vec2> accelerations) const {
    rows_.leave_out(reference, particles, viscosity_, accelerations);
  }

  std::vector<double>& viscosity() { return viscosity_; }    ///< mu of the control [Pa s]; and ghost
  const double* deforms() const { return deforms_.data(); }  ///< as in FlowView
  StressDiffusion& diffusion() { return diffusion_; }
  const WallWork& wall_work() const { return wall_work_; }
  LooseParticles& loose() { return loose_; }
  const LooseParticles& loose() const { return loose_; }

  /// Energy since the start [J/m].
  struct Work {
    double plastic = 0;                 ///< dissipated by the laws
    double viscous = 0;                 ///< by bulk viscosity
    double control = 0;                 ///< by the zero-energy control
    double diffusion = 0;               ///< lost from the elastic energy by the diffusion of stress
    double shift = 0;                   ///< gravity's energy gained by moving particles
    double beyond_linear_at_start = 0;  ///< energy_beyond_linear() then
  };
  const Work& work() const { return work_; }
  void add_dissipation(double plastic, double viscous) { work_.plastic += plastic, work_.viscous += viscous; }

  /// The work of the control is counted in one of some steps, for all of them: what it accelerates, with the
  /// velocities before, when forces have been summed ...
  void sample_work(const ReferenceConfiguration& reference, const Particles& particles,
                   const PlaneTensors& piola);
  /// ... and its work once these have changed the velocities, over a step dt [s].
  void count_work(const ReferenceConfiguration& reference, const Particles& particles, double dt);

  void visit(StateArchive& state);

 private:
  void update_density(Model& model) const;
  void even_out(Model& model, const ReferenceConfiguration& reference);

  std::vector<double> rest_density_;  ///< of each particle without stress [kg/m3]; empty in elastic soil
  std::vector<double> viscosity_;
  StressDiffusion diffusion_;
  RowsAtWalls rows_;
  std::vector<double> deforms_;  ///< as in FlowView
  LooseParticles loose_;
  WallWork wall_work_;
  ForceSample sample_;  ///< of the control
  bool has_flowed_ = false;
  Work work_;
};

/// Elastic energy of soil whose stiffness follows its state, less what the largest moduli would give at its
/// stress; 0 of other soil [J/m].
double energy_beyond_linear(const Model& model);

}  // namespace porosph
