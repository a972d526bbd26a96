// Drucker and Prager's elastic, perfectly plastic soil.
#pragma once

#include <cmath>

#include "solver/constitutive/material.hpp"

/// Yields where sqrt(J2) + alpha I1 = k, without changing its volume in doing so. alpha and k give
/// the strength of Mohr and Coulomb's cohesion and friction angle in plane strain (Drucker and Prager 1952).
class DruckerPrager : public porosph::Material {
 public:
  DruckerPrager(double cohesion, double friction_degrees) {
    const double t = std::tan(friction_degrees * std::acos(-1) / 180), root = std::sqrt(9 + 12 * t * t);
    alpha_ = t / root;
    k_ = 3 * cohesion / root;
  }

  /// The elastic step's stress, brought back to the yield surface where it has left it.
  porosph::Stress stress(const porosph::MaterialStep& step) override {
    const porosph::Stress& trial = step.elastic;
    const double excess = yield(trial);
    if (excess <= 0) return trial;
    const double strength = k_ - alpha_ * 3 * trial.mean();
    if (strength <= 0) {  // beyond the apex: the most tension that there may be
      const double apex = k_ / (3 * alpha_);
      return {apex, apex, apex, 0};
    }
    const double scale = strength / (strength + excess), mean = trial.mean() * (1 - scale);
    return {scale * trial.xx + mean, scale * trial.yy + mean, scale * trial.zz + mean, scale * trial.xy};
  }

  /// sqrt(J2) + alpha I1 - k: positive outside the yield surface [Pa].
  double yield(const porosph::Stress& s) const {
    const double m = s.mean(), xx = s.xx - m, yy = s.yy - m, zz = s.zz - m;
    return std::sqrt(0.5 * (xx * xx + yy * yy + zz * zz) + s.xy * s.xy) + alpha_ * 3 * m - k_;
  }

 private:
  double alpha_ = 0, k_ = 0;
};
