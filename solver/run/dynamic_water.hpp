// Excess pore pressure of saturated soil in motion: one pressure for each step.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/run/consolidation.hpp"
#include "solver/run/leapfrog.hpp"
#include "solver/run/water_stencils.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {

/// With W the volume of water that each particle has gained, dV that of its soil and h the excess head,
///
///   W = dV + S h + Z,      dW/dt = R(h),      rho dv/dt = div (sigma' + p_e I) + rho g,   p_e = -gamma_w h
///
/// and a step dt of the soil takes p_e at its end (incremental fractional step: Chorin 1968, Van Kan 1986):
/// with v* the velocity that the pressure at its start gives,
///
///   (S + dt H + T + dt^2 D 1/rho D^T gamma_w) dh = W + dt R(h) - dV(v*) - S h - Z,
///   v = v* + dt D^T dp_e / rho,     Z += T dh.
///
/// D is the soil's own rate of volume and D^T its adjoint, the force of a pressure: the matrix is symmetric
/// and positive, and water takes from the soil what it gets. D D^T is wide and blind for what alternates.
/// T = tau (L_compact - L_wide) with tau = gamma_w dt^2 / rho (see PressureStabilisation) completes it to the
/// compact Laplacian, by which conjugate gradients are preconditioned: in a lattice that is the answer, and
/// among particles that have flowed a few turns lead to it. Neither k nor K_w shortens the step. W is carried
/// on by what flows, so the water's balance is exact, and a step makes good what the one before it left.
class DynamicWater {
 public:
  struct Counts {
    std::int64_t steps = 0, krylov_iterations = 0, renewals = 0;
    std::int64_t turns = 0;  ///< of the conjugate gradients that those iterations precondition
  };

  DynamicWater(const Case& scene, Model& model, Dynamics& dynamics);

  /// Takes the water of soil that was at rest until now.
  void go_on_from(const Consolidation& rested);

  /// Thrown where no pressure lets the soil keep its water.
  struct Lost {
    std::size_t particle;
  };

  using Hold = std::function<void(std::span<Vec2>)>;

  /// In place of the dynamics' own: follows a renewed reference.
  void prepare();
  /// Adds what the present pressures do to the accelerations.
  void add_force(std::span<Vec2> accelerations);
  /// Adds to the accelerations, with which `kick` and a step dt [s] move the particles, what the change of
  /// pressure in that step does. `hold`, if given, makes of accelerations those that what holds the soil
  /// leaves of them; it must be linear and symmetric, and is still to be applied to the result. Throws Lost.
  void add_change(Kick kick, double dt, std::span<Vec2> accelerations, const Hold& hold);
  /// Takes in how the soil moved in a step dt [s]; returns how fast that changes its volume [1/s].
  /// `as_foreseen`: with the accelerations that add_change() left, held.
  std::span<const double> take_strain(double dt, bool as_foreseen);

  std::span<const double> head() const { return of_.head; }      ///< excess, of the particles [m]
  std::span<const double> excess() const { return of_.excess; }  ///< p_e [Pa]
  double drained() const { return drained_; }                    ///< volume that has left so far [m2]
  /// Volume that is missing: what the particles have lost less what has left [m2].
  double imbalance() const;
  /// Largest difference of W and what soil and pressure hold, over the particle's volume [-].
  double misfit() const;
  double energy() const;  ///< of the compressed water, per metre of thickness [J/m]
  /// What water_energy() makes of p_e where p_w includes it [J/m].
  double shown_energy() const;
  /// What the soil has given to the water: that energy, and what flow and implicit steps dissipate [J/m].
  double taken() const { return taken_; }
  const Counts& counts() const { return counts_; }
  void visit(StateArchive& state);  ///< saves or restores all of it

 private:
  /// Of each particle.
  struct Amounts {
    std::vector<double> storage;       ///< S [m]
    std::vector<double> gained;        ///< dV [m2]
    std::vector<double> head, excess;  ///< h [m]; p_e [Pa]
    std::vector<double> water;         ///< W [m2]
    std::vector<double> held;          ///< Z [m2]
    std::vector<double> change;        ///< the last dh [m]
  };
  /// Of each particle, where the soil ends.
  struct Surface {
    std::vector<double> open;         ///< what it adds to the compact Laplacian [m3/s2]
    std::vector<double> outlet;       ///< what flows out there per head, once the soil has moved [m/s]
    std::vector<std::uint8_t> fixed;  ///< 1 where the head stays 0
    bool is_known = false;
  };
  struct Step {
    double dt = 0, gain = 0;  ///< [s]
    bool operator==(const Step&) const = default;
  };
  struct Scratch {
    std::vector<double> rate, inflow, right_side, pressure, spread;
    std::vector<Vec2> velocity;  ///< that the pressure so far gives at the end of the step [m/s]
    std::vector<Vec2> push, held_push, present, change;
    std::vector<Mat2> rates;  ///< dF/dt at the end of the step [1/s]
    struct {
      SparseRows rows;
      Step of;
    } matrix;
    struct {
      std::vector<double> direction, answer, preconditioned;
      std::vector<Mat2> rates;  ///< of what the direction pushes
    } search;                   ///< of the conjugate gradients
  };
  void measure_surface();
  void find_fixed();
  void hold_by_new_stencils();
  void let_through();
  void make_matrix();
  double find_inflow();
  void make_right_side(Kick kick, std::span<const Vec2> accelerations);
  void solve(const Hold& hold);
  void precondition(double tolerance);
  void answer(std::span<const double> head, const Hold& hold);
  double turn(double overlap, const Hold& hold);
  bool is_enough(double start) const;
  void keep();
  void count_work();
  double held_water(std::size_t a) const {
    return of_.gained[a] + of_.storage[a] * of_.head[a] + of_.held[a];
  }
  std::size_t worst() const;

  Model& model_;
  Dynamics& dynamics_;
  double unit_weight_;
  WaterStencils stencils_;
  Amounts of_;
  Surface surface_;
  Step step_;  ///< the last
  Scratch work_;
  double drained_ = 0, taken_ = 0;
  Counts counts_;
};

}  // namespace porosph
