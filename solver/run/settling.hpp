// Brings soil to rest where it is: what follows a flow that is slow against its own waves.
#pragma once

#include <functional>
#include <span>

#include "solver/model/model.hpp"
#include "solver/run/relaxation.hpp"
#include "solver/sph/dynamics.hpp"

namespace porosph {

/// Adaptive dynamic relaxation until the forces have been in balance for as long as the lowest vibration
/// takes to show.
struct Settling {
  static constexpr double usually_enough = 1e-4;  ///< unbalanced force ratio at rest

  struct Task {
    std::function<std::span<const Vec2>()> forces;  ///< accelerations as the particles are now [m/s2]
    std::function<double()> ratio;                  ///< unbalanced force ratio of those [-]
    double enough;
  };
  /// Returns false where the soil has not come to rest while a wave crosses it 200 times, or has run away: it
  /// fails.
  bool settle(Model& model, Dynamics& dynamics, const Task& task);
  void visit(StateArchive& state);  ///< saves or restores what is kept

  double dt = 0;            ///< of a sweep [s]
  std::int64_t sweeps = 0;  ///< so far
  Relaxation relaxation = {};
};

}  // namespace porosph
