// Flow and deformation of saturated soil together, without inertia: consolidation.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/run/relaxation.hpp"
#include "solver/sph/dynamics.hpp"
#include "solver/water/flow/darcy_flow.hpp"

namespace porosph {

/// Water keeps its volume or leaves, whatever the soil does: with W the volume of water that each particle
/// has gained, dV that of its soil, h the excess head,
///
///   W = dV + S h,      dW/dt = R(h)      (Darcy's flow between particles and through faces),
///
/// and the soil is at rest under its effective stress and the excess pressure p_e = -gamma_w h together,
/// which act as one stress: P = J (sigma' + p_e I) F^-T. A flow step may be as long as its error allows
/// (SDIRK of second order, gamma = 1 - 1/sqrt 2: Alexander 1977). Within a stage the fixed-stress split (Kim,
/// Tchelepi, Juanes 2011) takes turns: the flow with the soil's stiffness M in place of its answer, then the
/// soil by dynamic relaxation. W is carried from step to step, so the water's balance is exact.
class Consolidation {
 public:
  struct Counts {
    std::int64_t flow_steps = 0, pressure_solves = 0, krylov_iterations = 0, soil_sweeps = 0;
  };

  /// `dt` of the soil's relaxation [s]. The particles must be at rest where they start.
  Consolidation(const Case& scene, Model& model, Dynamics& dynamics, double dt);

  /// One flow step from the time `now`, not beyond `until` [s]; returns the time that it reached. Throws
  /// std::runtime_error where the soil does not come to rest: it has failed.
  double advance(double now, double until);

  std::span<const double> head() const { return of_.head; }  ///< excess, of the particles [m]
  double drained() const { return progress_.drained; }       ///< volume that has left so far [m2]
  /// Volume that is missing: what the particles have lost less what has left [m2].
  double imbalance() const;
  std::span<const Vec2> accelerations() const {
    return soil_.accelerations;
  }                                 ///< at rest, those that are left
  void visit(StateArchive& state);  ///< saves or restores all of it
  const Counts& counts() const { return counts_; }
  /// Forces left by the last step, as in the tolerance [-].
  double unbalanced() const { return progress_.unbalanced; }

 private:
  void start();
  double flow_step(double now, double until);
  void settle(std::span<const double> known, double tau);
  void solve_flow(std::span<const double> known, double tau);
  void relax(int sweeps, double time);
  double volume_gained(std::size_t a) const;
  double out_of_balance() const;
  void take_up_pressure();
  void give_back_pressure();

  /// What brings the soil to rest.
  struct Soil {
    Model& model;
    Dynamics& dynamics;
    double dt;          ///< [s]
    double extent = 0;  ///< of the body [m]
    Relaxation relaxation = {};
    std::vector<Vec2> accelerations = {}, before = {};
  };
  /// What the water flows by.
  struct Drainage {
    HydraulicOutline outline;
    FaceConditions faces;
    DarcyFlow flow;
    std::vector<std::int32_t> pinned = {};  ///< patch of particles that lie on a face, or -1
    SparseRows slope = {};
  };
  /// Of each particle.
  struct Amounts {
    std::vector<double> start_volume, storage, split;  ///< V0 [m2]; S and beta of the split [m]
    std::vector<double> head, water;                   ///< excess h [m]; W [m2]
    std::vector<double> inflow, residual, change;      ///< of the present solve
  };
  struct Progress {
    double step = 0, time = 0;  ///< [s]
    double scale = 0;           ///< largest |h| so far [m]
    double drained = 0;         ///< [m2]
    double unbalanced = 0;
    bool started = false;
  };
  static Drainage drainage(const Case& scene, const Particles& particles);

  Soil soil_;
  CouplingCase settings_;
  double unit_weight_;
  Drainage drainage_;
  Amounts of_;
  Progress progress_;
  Counts counts_;
};

}  // namespace porosph
