// Clay sheared without drainage that loses strength as it yields.
#pragma once

#include <cmath>

#include "solver/soil/external_law.hpp"

/// Yields where the shear stress sqrt(J2) reaches the undrained strength, which falls from its peak to a
/// residual value, s_u = s_r + (s_p - s_r) exp(-e / e_r), with the plastic strain e. Strength and plastic
/// strain are local: results depend on the spacing once a band of failure has formed.
class SofteningClay : public porosph::ExternalLaw {
 public:
  /// Strengths in Pa.
  SofteningClay(const porosph::Elasticity& elastic, double peak, double residual, double reference_strain)
      : ExternalLaw(elastic), peak_(peak), residual_(residual), reference_strain_(reference_strain) {}

  std::vector<porosph::Field> history() const override { return {plastic_strain}; }

  void step(const porosph::SoilTile& tile) const override {
    for (std::int32_t i = 0; i < tile.count; ++i) {
      double* s = tile.stress + 4 * i;
      const porosph::Gradient gradient(tile.gradient[0][i], tile.gradient[1][i], tile.gradient[2][i],
                                       tile.gradient[3][i]);
      const porosph::Stress trial = elastic().elastic_step({s[0], s[1], s[2], s[3]}, gradient, tile.dt);
      const porosph::Stress now = returned(trial, tile.history[0][i]);
      s[0] = now.xx, s[1] = now.yy, s[2] = now.zz, s[3] = now.xy;
    }
  }

 private:
  /// Plastic strain is known to charts and files under the name that other laws give it too.
  static constexpr porosph::Field plastic_strain{"PlasticStrain", "-", "εᵖ", "plastic strain",
                                                 "sum of sqrt(2/3 de : de)"};

  /// The elastic step's stress, brought back to the present strength where it is beyond it.
  porosph::Stress returned(const porosph::Stress& trial, double& strain) const {
    const double m = trial.mean(), xx = trial.xx - m, yy = trial.yy - m, zz = trial.zz - m;
    const double shear = std::sqrt(0.5 * (xx * xx + yy * yy + zz * zz) + trial.xy * trial.xy);
    const double strength = residual_ + (peak_ - residual_) * std::exp(-strain / reference_strain_);
    if (shear <= strength) return trial;
    strain += (shear - strength) / (elastic().shear_modulus * std::sqrt(3.0));
    const double scale = strength / shear;
    return {m + scale * xx, m + scale * yy, m + scale * zz, scale * trial.xy};
  }

  double peak_, residual_, reference_strain_;
};
