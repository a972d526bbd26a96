// Drucker and Prager's soil: elastic and plastic, with friction, cohesion and dilation.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/soil/elasticity.hpp"
#include "solver/soil/law.hpp"
#include "solver/soil/law_fields.hpp"
#include "solver/soil/softening.hpp"

namespace porosph {

/// Yields where sqrt(J2) + alpha I1 = k and flows along sqrt(J2) + beta I1 (Drucker and Prager 1952). In
/// plane strain it has the strength of Mohr and Coulomb's c, phi and dilates by psi, up to a volume strain.
/// With plastic strain, alpha, k and beta may fall to their residual values.
struct DruckerPrager : Elasticity {
  struct History {
    double plastic_strain = 0;
    double opening = 0;
    double dilation = 0;
  };
  static constexpr std::array<Field, 3> history{law_fields::plastic_strain, law_fields::opening,
                                                law_fields::dilation};

  double alpha = 0, k = 0;  ///< of the yield surface [-], [Pa]
  double beta = 0;          ///< of the plastic potential [-]
  double tension =
      std::numeric_limits<double>::max();  ///< most mean tension, where the apex is not less [Pa]
  double sin_phi = 0;                      ///< of the friction angle
  double dilation_limit =
      std::numeric_limits<double>::max();  ///< volume strain of plastic flow at which dilation ends
  double k_at_limit = 0;                   ///< k of the same strength without dilation [Pa]
  Softening softening = {};
  double residual_alpha = 0, residual_k = 0, residual_sin_phi = 0;  ///< of no use without softening

  /// Cohesion [Pa], friction and dilation angle [degrees], most mean tension [Pa]. With D = 3 sqrt(1 - 3
  /// beta^2) + 3 beta sin(phi) the strength in plane strain is that of Mohr and Coulomb: alpha = sin(phi) /
  /// D, k = 3 c cos(phi) / D.
  static DruckerPrager from_mohr_coulomb(const Elasticity& elastic, double cohesion, double friction,
                                         double dilation = 0,
                                         double tension = std::numeric_limits<double>::max()) {
    const double phi = friction * std::numbers::pi / 180, t = std::tan(dilation * std::numbers::pi / 180);
    DruckerPrager law{elastic};
    law.beta = t / std::sqrt(9 + 12 * t * t);
    const double d = 3 * std::sqrt(1 - 3 * law.beta * law.beta) + 3 * law.beta * std::sin(phi);
    law.alpha = std::sin(phi) / d;
    law.k = 3 * cohesion * std::cos(phi) / d;
    law.tension = tension;
    law.sin_phi = std::sin(phi);
    law.k_at_limit = cohesion * std::cos(phi);
    return law;
  }
  /// The same, softening to a residual cohesion [Pa] and friction angle [degrees] without dilation.
  DruckerPrager softened_to(double cohesion, double friction, Softening by) const {
    const DruckerPrager residual = from_mohr_coulomb(*this, cohesion, friction);
    DruckerPrager law = *this;
    law.softening = by;
    law.residual_alpha = residual.alpha, law.residual_k = residual.k;
    law.residual_sin_phi = residual.sin_phi;
    return law;
  }

  /// sqrt(J2) + alpha I1 - k: positive outside the yield surface [Pa].
  template <class Space>
  double yield(const Symmetric<Space>& s, const History& q) const {
    return shear_stress(s) - shear_strength(s, q);
  }
  /// The same of soil that has not yielded yet.
  template <class Space>
  double yield(const Symmetric<Space>& s) const {
    return yield(s, History());
  }
  /// sqrt(J2), and the most that the law bears at this mean stress [Pa].
  template <class Space>
  double shear_stress(const Symmetric<Space>& s) const {
    return root_j2(s);
  }
  template <class Space>
  double shear_strength(const Symmetric<Space>& s, const History& q) const {
    const Surface now = surface(q);
    return now.k - 3 * now.alpha * s.mean();
  }
  double sin_friction(const History& q) const {
    return residual_sin_phi + (sin_phi - residual_sin_phi) * softening.left(q.plastic_strain);
  }

  /// The elastic step's stress, returned to the yield surface where it has left it: radially in the deviator
  /// and by the dilation in the mean, then to the apex where that is passed. What opens there has to close
  /// before mean stress returns.
  template <class Space>
  [[gnu::always_inline]] Symmetric<Space> step(const Symmetric<Space>& old,
                                               const GradientIn<Space>& velocity_gradient, double dt,
                                               History& q) const {
    const auto [trial, shut] = closing_step(old, velocity_gradient, dt, q.opening);
    const Surface now = surface(q);
    const double mean = trial.mean(), root = root_j2(trial);
    const double excess = root + 3 * now.alpha * mean - now.k;
    const double compliance = 1 / (shear_modulus + 9 * bulk_modulus * now.alpha * now.beta);
    const double multiplier = (excess > 0 ? excess : 0) * compliance;
    const double returned = mean - 3 * bulk_modulus * now.beta * multiplier;
    const double new_mean = returned < now.largest_mean ? returned : now.largest_mean;
    const double on_surface = root - shear_modulus * multiplier, strength = now.k - 3 * now.alpha * new_mean;
    const double lower = on_surface < strength ? on_surface : strength;
    const double new_root = lower > 0 ? lower : 0;
    const double scale = root > 0 ? new_root / root : 1;
    q.dilation += (mean - returned) / bulk_modulus;
    q.opening += (returned - new_mean) / bulk_modulus - shut;
    q.plastic_strain += (root - new_root) / (shear_modulus * std::numbers::sqrt3);
    return (trial * scale).plus_isotropic(new_mean - scale * mean);
  }

 private:
  struct Surface {
    double alpha, k, beta;
    double largest_mean;  ///< of the apex, or the tension cut-off below it [Pa]
  };
  [[gnu::always_inline]] Surface surface(const History& q) const {
    const double left = softening.left(q.plastic_strain);
    const bool dilates = q.dilation < dilation_limit;
    const double peak_alpha = dilates ? alpha : sin_phi / 3, peak_k = dilates ? k : k_at_limit;
    const double a = residual_alpha + (peak_alpha - residual_alpha) * left;
    const double c = residual_k + (peak_k - residual_k) * left;
    const double apex = a > 0 ? c / (3 * a) : std::numeric_limits<double>::max();
    return {a, c, dilates ? beta * left : 0, apex < tension ? apex : tension};
  }
  template <class Space>
  static double root_j2(const Symmetric<Space>& s) {
    return std::sqrt(0.5 * s.plus_isotropic(-s.mean()).squared());
  }
};
static_assert(YieldingLaw<DruckerPrager>);

}  // namespace porosph
