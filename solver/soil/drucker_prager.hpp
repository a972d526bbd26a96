// Drucker and Prager's soil: elastic, perfectly plastic, with friction, cohesion and dilation.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/soil/elasticity.hpp"
#include "solver/soil/law.hpp"

namespace porosph {

/// Yields where sqrt(J2) + alpha I1 = k and flows along sqrt(J2) + beta I1 (Drucker and Prager 1952). In
/// plane strain it has the strength of Mohr and Coulomb's c, phi and dilates by psi.
struct DruckerPrager : Elasticity {
  struct History {
    double plastic_strain = 0;
  };
  static constexpr std::array<Field, 1> history{
      {{.name = "PlasticStrain",
        .unit = "-",
        .symbol = "εᵖ",
        .words = "plastic strain",
        .meaning = "sum of sqrt(2/3 de : de), e the deviatoric plastic strain",
        .kind = FieldKind::scalar}}};

  double alpha = 0, k = 0;  ///< of the yield surface [-], [Pa]
  double beta = 0;          ///< of the plastic potential [-]
  double largest_mean = 0;  ///< most tension: the apex, or the tension cut-off below it [Pa]

  /// Cohesion [Pa], friction and dilation angle [degrees], most mean tension [Pa]. With D = 3 sqrt(1 - 3
  /// beta^2) + 3 beta sin(phi) the strength in plane strain is that of Mohr and Coulomb: alpha = sin(phi) /
  /// D, k = 3 c cos(phi) / D.
  static DruckerPrager from_mohr_coulomb(const Elasticity& elastic, double cohesion, double friction,
                                         double dilation = 0,
                                         double tension = std::numeric_limits<double>::infinity()) {
    const double phi = friction * std::numbers::pi / 180, t = std::tan(dilation * std::numbers::pi / 180);
    DruckerPrager law{elastic};
    law.beta = t / std::sqrt(9 + 12 * t * t);
    const double d = 3 * std::sqrt(1 - 3 * law.beta * law.beta) + 3 * law.beta * std::sin(phi);
    law.alpha = std::sin(phi) / d;
    law.k = 3 * cohesion * std::cos(phi) / d;
    const double apex = law.alpha > 0 ? law.k / (3 * law.alpha) : std::numeric_limits<double>::max();
    law.largest_mean = std::min(apex, tension);
    return law;
  }

  /// sqrt(J2) + alpha I1 - k: positive outside the yield surface [Pa].
  template <class Space>
  double yield(const Symmetric<Space>& s) const {
    return root_j2(s) + 3 * alpha * s.mean() - k;
  }

  /// The elastic step's stress, returned to the yield surface where it has left it: radially in the deviator
  /// and by the dilation in the mean, then to the apex where that is passed.
  template <class Space>
  Symmetric<Space> step(const Symmetric<Space>& old, const GradientIn<Space>& velocity_gradient, double dt,
                        History& q) const {
    const Symmetric<Space> trial = elastic_step(old, velocity_gradient, dt);
    const double mean = trial.mean(), root = root_j2(trial);
    const double excess = root + 3 * alpha * mean - k;
    const double compliance = 1 / (shear_modulus + 9 * bulk_modulus * alpha * beta);
    const double multiplier = (excess > 0 ? excess : 0) * compliance;
    const double returned = mean - 3 * bulk_modulus * beta * multiplier;
    const double new_mean = returned < largest_mean ? returned : largest_mean;
    const double on_surface = root - shear_modulus * multiplier, strength = k - 3 * alpha * new_mean;
    const double lower = on_surface < strength ? on_surface : strength;
    const double new_root = lower > 0 ? lower : 0;
    const double scale = root > 0 ? new_root / root : 1;
    const double strain_per_stress = 1 / (shear_modulus * std::numbers::sqrt3);
    q.plastic_strain += (root - new_root) * strain_per_stress;
    return (trial * scale).plus_isotropic(new_mean - scale * mean);
  }
  template <class Space>
  double constrained_modulus(const Symmetric<Space>&, const History&) const {
    return Elasticity::constrained_modulus();
  }
  using Elasticity::constrained_modulus;

 private:
  template <class Space>
  static double root_j2(const Symmetric<Space>& s) {
    return std::sqrt(0.5 * s.plus_isotropic(-s.mean()).squared());
  }
};
static_assert(SoilLaw<DruckerPrager>);

}  // namespace porosph
