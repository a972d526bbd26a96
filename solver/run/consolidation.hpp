// Flow and deformation of saturated soil together, without inertia: consolidation, and loading without
// drainage.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/run/drainage.hpp"
#include "solver/run/pore_permeability.hpp"
#include "solver/run/resting_soil.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {

/// Water keeps its volume or leaves, whatever the soil does: with W the volume of water that each particle
/// has gained, dV that of its soil, h the excess head,
///
///   W = dV + S h + T h,      dW/dt = R(h)      (Darcy's flow between particles and through faces),
///
/// and the soil is at rest under its effective stress, by which it yields, and the excess pressure
/// p_e = -gamma_w h. T keeps h from alternating (PressureStabilisation). A flow step may be as long as its
/// error allows (SDIRK of second order, gamma = 1 - 1/sqrt 2: Alexander 1977). Within a stage the
/// fixed-stress split (Kim, Tchelepi, Juanes 2011) takes turns: the flow with the soil's elastic stiffness M
/// in place of its answer, then the soil by dynamic relaxation. W is carried from step to step, so the
/// water's balance is exact. Undrained, W stays 0 and a step is one of the loads.
class Consolidation {
 public:
  struct Counts {
    std::int64_t flow_steps = 0, pressure_solves = 0, krylov_iterations = 0, soil_sweeps = 0;
  };

  /// `dt` of the soil's relaxation [s]. The particles must be at rest where they start.
  Consolidation(const Case& scene, Model& model, Dynamics& dynamics, SurfaceForces& surface, double dt);

  /// One flow step from the time `now`, not beyond `until` [s]; returns the time that it reached. Throws
  /// std::runtime_error where the soil does not come to rest: it has failed.
  double advance(double now, double until);

  /// After a step from `now` that did not come to rest at the time `lost` [s], and once the state before it
  /// is back: halves the next step. Returns false where that is shorter than a sixteenth of the step that
  /// failed first, so that the moment of failure is known to as much.
  bool seek_failure(double now, double lost);

  std::span<const double> head() const { return of_.head; }          ///< excess, of the particles [m]
  double water_gained(std::size_t a) const { return of_.water[a]; }  ///< W of a particle [m2]
  double volume_gained(std::size_t a) const { return soil_.volume_gained(a); }   ///< dV [m2]
  double held_by_stabilisation(std::size_t a) const { return of_.smoothed[a]; }  ///< T h [m2]
  double time() const { return progress_.time; }        ///< that the last step sought rest at [s]
  double drained() const { return progress_.drained; }  ///< volume that has left so far [m2]
  /// Volume that is missing: what the particles have lost less what has left [m2].
  double imbalance() const;
  std::span<const Vec2> accelerations() const { return soil_.accelerations(); }  ///< those that are left
  void visit(StateArchive& state);  ///< saves or restores all of it
  Counts counts() const;

  /// Forces left by the last step, as in the tolerance [-].
  double unbalanced() const { return progress_.unbalanced; }

 private:
  void start();
  double flow_step(double now, double until);
  double load_step(double now, double until);
  void settle(std::span<const double> known, double tau);
  void take_turns(std::span<const double> known, double tau);
  void guess();
  void solve_flow(std::span<const double> known, double tau);
  void assemble();
  void follow_pores();
  void choose_step(double step, std::span<const double> first_inflow);
  double water_of(std::size_t a) const;
  void show_pressure(double sign);

  /// Of each particle.
  struct Amounts {
    std::vector<double> storage, split;            ///< S and beta of the split [m]
    std::vector<double> head, water;               ///< excess h [m]; W [m2]
    std::vector<double> smoothed;                  ///< T h [m2]
    std::vector<double> inflow, residual, change;  ///< of the present solve
  };
  struct Progress {
    double step = 0, time = 0;  ///< [s]
    double scale = 0;           ///< largest |h| so far [m]
    double drained = 0;         ///< [m2]
    double unbalanced = 0;
    bool started = false;
    double failed_step = 0, failed_at = 0;  ///< that shorter steps lead towards; 0: none [s]
  };
  /// How the soil came to rest, at the end of a stage.
  struct Rest {
    double time;  ///< [s]
    std::vector<Vec2> position;
    std::vector<double> head;
  };

  Model& model_;
  RestingSoil soil_;
  CouplingCase settings_;
  double unit_weight_;
  std::optional<Drainage> drainage_;  ///< nothing: undrained
  PorePermeability pores_;
  PressureStabilisation stabilisation_;
  SparseRows slope_;
  Amounts of_;
  Progress progress_;
  std::vector<Rest> rests_;  ///< the last ones, at different times
  Counts counts_;
};

}  // namespace porosph
