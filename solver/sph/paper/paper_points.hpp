// What the paper's sums read of particles and ghosts.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/model/model.hpp"
#include "solver/sph/kernels/paper_kernels.hpp"

namespace porosph {

/// Arrays of particles, then ghosts behind rollers.
class PaperPoints {
 public:
  /// Finds the ghosts within `range` [m] of the walls from `first_roller` on, and makes room for them.
  void find_ghosts(const Model& model, std::size_t first_roller, double range);

  /// Takes the particles' present positions, and moves the ghosts with them.
  void take_positions(const Particles& particles);
  /// V = m / rho, rho, and the speed of sound of eq. (16).
  void take_volumes(const Model& model);
  void take_velocities(const Particles& particles);
  /// sigma' + p_w I, or sigma' / rho where the form asks for it, and p_w.
  void take_stress(const Model& model, bool over_density);

  const std::vector<Vec2>& places() const { return places_; }
  const Ghosts& ghosts() const { return ghosts_; }
  double volume(std::size_t i) const { return volume_[i]; }
  double density(std::size_t i) const { return density_[i]; }
  double sound(std::size_t i) const { return sound_[i]; }
  void connect(PaperPointsView& points) const;

 private:
  std::vector<Vec2> places_;
  Ghosts ghosts_;
  std::array<std::vector<double>, 2> position_, velocity_;
  std::array<std::vector<double>, 3> stress_;  ///< xx, yy, xy
  std::vector<double> volume_, density_, sound_, pressure_;
};

}  // namespace porosph
