// Flow over time in soil that is saturated in part (Richards 1931).
#pragma once

#include <span>
#include <vector>

#include "solver/particles/state.hpp"
#include "solver/water/flow/darcy_flow.hpp"
#include "solver/water/flow/face_switch.hpp"

namespace porosph {

/// Per volume of soil: water above what stays [-] and its slope [1/m].
struct WaterContent {
  double value, slope;
};

/// What a soil's pores hold: theta - theta_r = (n - theta_r) Se(psi), and below the water table what the
/// compression of the water adds, n gamma_w / K_w psi.
struct Pores {
  double free = 0;     ///< n - theta_r [-]
  double elastic = 0;  ///< n gamma_w / K_w [1/m]

  WaterContent content(const Retention& retention, double psi) const {
    const Retention::Stored s = retention.stored(psi);
    return {free * s.saturation + (psi > 0 ? elastic * psi : 0), free * s.slope + (psi > 0 ? elastic : 0)};
  }
};

/// With W the water of each particle, W = V theta(psi),
///
///   dW/dt = R(h)      (Darcy's flow between particles and through faces),
///
/// in steps of SDIRK (second order, gamma = 1 - 1/sqrt 2: Alexander 1977), each stage solved by Newton's
/// method. W is carried from step to step by what has flowed, so the water's balance does not drift, however
/// well a stage is solved. The length of steps follows from the difference to the step of first order that is
/// embedded. A stage that does not converge is tried again in a shorter step, in the end with kr of where
/// water comes from.
class Richards {
 public:
  struct Counts {
    std::int64_t steps = 0, refused = 0, newton_steps = 0, krylov_iterations = 0;
  };
  struct Settings {
    double first_step = 0;  ///< [s]
    double least_step = 0;  ///< that fails where it cannot be solved either [s]
    double growth = 1.3;    ///< of steps, at most
    double tolerance = 0;   ///< of Se: root mean square of the error of a step [-]
  };
  /// Where and when no step however short can be solved.
  struct NotConverged {
    std::size_t particle;  ///< where most is left
    double time, step;     ///< [s]
  };
  struct Start {
    std::vector<double> head;  ///< of the particles [m]
    FaceConditions faces;
  };

  /// `pores` of each particle. `faces`: how many face_of_patch may name; -1 is none of them.
  Richards(DarcyFlow& flow, std::vector<Pores> pores, std::vector<int> face_of_patch, std::size_t faces,
           Start start, const Settings& settings);

  /// One step from the time `now`, not beyond `until` [s]; returns the time that it reached. Throws
  /// NotConverged.
  double advance(double now, double until);

  std::span<const double> head() const { return of_.head; }
  const FaceConditions& faces() const { return faces_; }
  const Counts& counts() const { return counts_; }

  struct Balance {
    double entered = 0, left = 0;  ///< since the start [m2]
    double gained = 0;             ///< by the particles, as their heads tell [m2]
    /// Of what has moved [-].
    double error() const {
      const double moved = entered + left;
      return moved > 0 ? (gained - entered + left) / moved : 0;
    }
  };
  Balance balance() const;
  /// Into the soil through each face, as a mean over the last step [m2/s].
  const std::vector<double>& through_faces() const { return through_faces_; }

  void visit(StateArchive& state);  ///< saves or restores all of it

 private:
  bool solve(std::span<const double> known, double tau, double time);
  double assemble(std::span<const double> known, double tau, DarcyFlow::Slope kind);
  bool find_change();
  void change_heads(std::span<const double> before, double share);
  bool step_by_secant(std::span<const double> known, double tau, double& size);
  bool improve(std::span<const double> known, double tau, double& size);
  bool try_step(double now, double step, std::vector<double>& first, std::vector<double>& through);
  void keep(double step, const std::vector<double>& through);
  double error_of(double step, std::span<const double> first) const;
  double water(std::size_t a) const;

  /// Of the particles.
  struct Amounts {
    std::vector<double> head, water;  ///< [m], W [m2]
    double water_at_start = 0;        ///< of all [m2]
  };
  DarcyFlow& flow_;
  std::vector<Pores> pores_;  ///< of each particle, times its volume [m2, m]
  std::vector<int> face_of_patch_;
  Settings settings_;
  Amounts of_;
  FaceConditions faces_;
  double next_step_, time_ = 0;  ///< [s]; [s] that the faces are of
  Balance sums_;
  std::vector<double> through_faces_;
  Counts counts_;

  struct Work {
    SparseRows slope = {};
    std::vector<double> inflow = {}, residual = {}, change = {}, storing = {};
    std::vector<std::int32_t> pinned = {};
  };
  Work work_;
};

}  // namespace porosph
