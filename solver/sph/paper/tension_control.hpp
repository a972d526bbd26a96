// Artificial stress of particles and ghosts, and its part of C_ab.
#pragma once

#include <vector>

#include "solver/boundary/ghosts.hpp"
#include "solver/model/model.hpp"
#include "solver/sph/kernel/cubic_spline.hpp"

namespace porosph {

/// (R_a + R_b) f^n with f = W(r) / W(dx), n = W(0) / W(dx).
class TensionControl {
 public:
  TensionControl(const Model& model, double strength);

  /// R of the particles' present stress, and of the ghosts.
  void take_stress(const Particles& particles, const Ghosts& ghosts);
  /// False while nothing is in tension.
  bool active() const { return active_; }

  /// R: {xx, yy, xy} [Pa m6/kg2].
  const Eigen::Vector3d& of(std::size_t i) const { return values_[i]; }
  double factor(double distance) const;  ///< f^n

 private:
  double strength_;  ///< epsilon
  CubicSpline<2> kernel_;
  double at_spacing_;  ///< W(dx)
  double exponent_;    ///< n
  std::vector<Eigen::Vector3d> values_;
  bool active_ = false;
};

}  // namespace porosph
