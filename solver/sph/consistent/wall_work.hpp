// What walls take from soil that flows, beyond what its law dissipates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/particles/state.hpp"
#include "solver/sph/consistent/reference.hpp"

namespace porosph {

/// With flux Phi = fill P L, the forces of walls and the strain that their ghosts g cause in the soil have
/// the power
///
///   sum_a V_a sum_g (Phi_g . v_a + Phi_a . v_g) G_ag
///
/// together. It vanishes where the stress of the ghosts is mirrored as their motion is. Stress that is
/// extrapolated behind walls, and friction, give it a value: the walls' own.
class WallWork {
 public:
  /// For a new reference; 1 where a particle sees ghosts.
  void take(std::span<const std::uint8_t> see_ghosts);

  /// What acts now, in one of some steps; `piola` is P of the particles that see ghosts, and of the ghosts.
  void sample(const ReferenceConfiguration& reference, const Particles& particles, const PlaneTensors& piola);
  /// Adds the work of that once it has changed the velocities, over a step dt [s].
  void count(const ReferenceConfiguration& reference, const Particles& particles, double dt);

  std::span<const std::int32_t> particles_at_walls() const { return at_walls_; }
  double work() const { return work_; }  ///< taken since the start [J/m]
  void visit(StateArchive& state);

 private:
  std::vector<std::int32_t> at_walls_;  ///< particles that see ghosts
  std::vector<Vec2> force_;             ///< sum_g Phi_g G_ag of each of those [Pa/m]
  std::vector<Mat2> flux_;              ///< Phi of each [Pa]
  std::vector<Vec2> velocity_;          ///< of all, before [m/s]; empty where no sample is due
  std::int64_t steps_ = 0;
  double work_ = 0;
};

}  // namespace porosph
