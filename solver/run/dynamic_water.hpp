// Excess pore pressure of saturated soil in motion: one pressure solve for each step.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/run/consolidation.hpp"
#include "solver/run/drainage.hpp"
#include "solver/run/leapfrog.hpp"
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
/// D is the soil's own rate of volume and D^T its adjoint, the soil's own force. Their product is wide and
/// blind for what alternates. T = tau (L_compact - L_wide) with tau = gamma_w dt^2 / rho (see
/// PressureStabilisation) completes it to the compact Laplacian, which is what is solved with: inside the
/// soil the solution is that of the step, to the tolerance, so neither k nor K_w shortens the step. W is
/// carried on by what flows, so the water's balance is exact, and a step makes good what the one before it
/// left.
///
/// Stencils of the flow are those of the soil as drawn until the soil's reference is renewed, from then on
/// those of its particles as they lie: walls mirror them, and the free surface drains.
class DynamicWater {
 public:
  struct Counts {
    std::int64_t steps = 0, krylov_iterations = 0, renewals = 0, solves = 0;
  };

  DynamicWater(const Case& scene, Model& model, Dynamics& dynamics);

  /// Thrown where W and what soil and pressure hold have parted.
  struct Lost {
    std::size_t particle;
  };

  /// From soil at rest in a flow over time, which particles take along: no excess pressure arises.
  void begin_drained();
  /// In place of the dynamics' own: follows a renewed reference.
  void prepare();
  /// Adds what the present pressures do to the accelerations.
  void add_force(std::span<Vec2> accelerations);
  /// Adds to the accelerations, with which `kick` and a step dt [s] move the particles, what the change of
  /// pressure in that step does. Throws Lost.
  void add_change(Kick kick, double dt, std::span<Vec2> accelerations);

  /// Takes in how the soil moved in a step dt [s]; returns how fast that changes its volume [1/s].
  std::span<const double> take_strain(double dt);

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
    std::vector<double> open;          ///< what the free surface adds to the compact Laplacian [m3/s2]
    std::vector<double> outlet;        ///< what flows out there per head, once the soil has moved [m/s]
  };
  struct Stencils {
    std::optional<Drainage> drainage;  ///< nothing: undrained
    PressureStabilisation inertia;     ///< T for dt = 1 s
    SparseRows flow;                   ///< -dR/dh
    std::vector<double> still_inflow;  ///< R(0) [m2/s]
  };
  struct Scratch {
    std::vector<double> rate, inflow, right_side, pressure, spread;
    std::vector<Vec2> velocity, push, total_push;
    SparseRows matrix;
    double of_last_dt = 0, of_last_gain = 0;
    double of_dt = 0, of_gain = 0;  ///< the step that the matrix is for [s]
  };
  void find_fixed();
  void renew();
  void make_stencils(const Particles& as_they_lie);
  void take_stencils();
  void measure_surface();
  void check_volumes() const;
  void let_through();
  void make_matrix(double dt, double gain);
  double find_inflow();
  void make_right_side(Kick kick, double dt, std::span<const Vec2> accelerations);
  void answer(std::span<const double> x, double dt, double gain, std::vector<double>& out);
  void solve(double dt, double gain);
  void keep(double dt, double gain);
  double held_water(std::size_t a) const;

  Case scene_;
  Model& model_;
  Dynamics& dynamics_;
  double unit_weight_;
  std::vector<double> inertia_;          ///< gamma_w / rho of each soil [m/s2]
  bool drained_soil_ = false;            ///< no excess pressure arises
  std::vector<std::uint8_t> fixed_;      ///< of the particles: they keep their head, 0
  Amounts of_;
  Stencils stencils_;
  Scratch work_;
  /// Where the present stencils were made; nothing: as drawn.
  std::vector<Vec2> made_at_;
  std::vector<double> density_then_;
  double drained_ = 0;
  bool surface_is_known_ = false;
  Counts counts_;
};

}  // namespace porosph
