// Modified Cam-clay: soil that hardens as it is compressed and softens as it dilates.
#pragma once

#include <cmath>
#include <numbers>

#include "solver/soil/elasticity.hpp"
#include "solver/soil/exponential.hpp"
#include "solver/soil/law.hpp"
#include "solver/soil/law_fields.hpp"

namespace porosph {

/// Roscoe and Burland (1968), with logarithmic strain and the lines ln(1 + e) over ln p (Butterfield 1979):
/// q^2 / M^2 + P (P - Pc) <= 0, plastic flow along the surface's normal, P = p' + attraction, Pc = pc +
/// attraction; d(volume strain) = lambda* dPc / Pc + kappa* d(P / Pc) / (P / Pc) in compression, elastic bulk
/// modulus P / kappa*, lambda* = lambda / (1 + e0). The attraction gives soil without stress a stiffness.
///
/// The base's moduli are the most that the soil may reach: they set the time step.
struct CamClay : Elasticity {
  static constexpr bool stiffness_varies = true;  ///< with the state: see FlowView

  struct History {
    double plastic_strain = 0;
    double opening = 0;
    double void_ratio = 0;
    double preconsolidation = 0;  ///< pc [Pa]
  };
  static constexpr std::array<Field, 4> history{law_fields::plastic_strain, law_fields::opening,
                                                law_fields::void_ratio, law_fields::preconsolidation};

  double ratio = 1;              ///< M
  double compressibility = 0;    ///< lambda* [-]
  double swelling = 0;           ///< kappa* [-]
  double shear_ratio = 0;        ///< G / K
  double attraction = 0;         ///< [Pa]
  double void_ratio = 0;         ///< e0
  double preconsolidation = 0;   ///< pc at the start; 0: by overconsolidation [Pa]
  double overconsolidation = 1;  ///< Pc over what the stress at the start needs

  /// What a particle with this stress remembers: soil that bears more than its preconsolidation has been
  /// consolidated by that.
  History at_start(const Vec2&, const Stress& stress) const { return start(stress); }
  template <class Space>
  History start(const Symmetric<Space>& stress) const {
    const double p = pressure(stress), q = deviator(stress) / ratio;
    const double needed = p + q * q / p;
    const double given = preconsolidation > 0 ? preconsolidation + attraction : overconsolidation * needed;
    return {0, 0, void_ratio, (given > needed ? given : needed) - attraction};
  }

  /// q / sqrt(3), and what of it the soil bears at the critical state [Pa].
  template <class Space>
  double shear_stress(const Symmetric<Space>& s) const {
    return deviator(s) / std::numbers::sqrt3;
  }
  template <class Space>
  double shear_strength(const Symmetric<Space>& s, const History&) const {
    return ratio * pressure(s) / std::numbers::sqrt3;
  }
  /// In triaxial compression.
  double sin_friction(const History&) const { return 3 * ratio / (6 + ratio); }

  /// Bulk modulus exact over the step, shear modulus of its start.
  template <class Space>
  [[gnu::always_inline]] Symmetric<Space> elastic_step(const Symmetric<Space>& old,
                                                       const GradientIn<Space>& velocity_gradient,
                                                       double dt) const {
    return elastic(old, velocity_gradient, dt, velocity_gradient.trace() * dt);
  }

  template <class Space>
  [[gnu::always_inline]] Symmetric<Space> step(const Symmetric<Space>& old,
                                               const GradientIn<Space>& velocity_gradient, double dt,
                                               History& q) const {
    const double volume = velocity_gradient.trace() * dt, shut = closing(q.opening, volume);
    const Symmetric<Space> trial = elastic(old, velocity_gradient, dt, volume + shut);
    const double before = pressure(old), unchanged = attraction - trial.mean();
    // Below the least pressure soil comes apart.
    const double least = least_pressure(), p = unchanged < least ? least : unchanged;
    const double stretch = before > least * (1 + 1e-9) ? swelling * (1 - unchanged / least) : volume + shut;
    const double opened = unchanged < least ? stretch : 0;
    const double pc = q.preconsolidation + attraction, shear = deviator(trial);
    const Plastic r =
        returned(p / pc, shear / (ratio * pc), 6 * shear_ratio * before / (swelling * ratio * ratio * pc));
    const double scale = 1 / (1 + r.shrinkage);
    q.plastic_strain += r.multiplier * 2 * scale * shear / (ratio * ratio * pc);
    q.opening += opened - shut;
    q.preconsolidation = pc * r.growth - attraction;
    q.void_ratio = (1 + q.void_ratio) * exponential(volume + shut - opened) - 1;
    return (trial * scale).plus_isotropic(attraction - p * r.fall - scale * trial.mean());
  }

  /// Of the state; of the case, the most that it may reach.
  template <class Space>
  double constrained_modulus(const Symmetric<Space>& s, const History&) const {
    return (1 + 4 * shear_ratio / 3) * pressure(s) / swelling;
  }
  using Elasticity::constrained_modulus;

  /// Elastic energy per volume: work of p' = P - attraction along the swelling line, and of shear at the
  /// present G. As G follows P, a closed path in stress may keep a little more or less than this.
  double swelling_energy(const Stress& s) const {
    const double p = pressure(s), shear = shear_ratio * p / swelling;
    return swelling * (p - attraction - attraction * std::log(p / attraction)) +
           s.plus_isotropic(-s.mean()).squared() / (4 * shear);
  }

  /// Volume strain since the start without what has opened, less that of an elastic soil with the base's bulk
  /// modulus.
  template <class Space>
  double plastic_dilation(const Symmetric<Space>& s, const History& q) const {
    return std::log((1 + q.void_ratio) / (1 + void_ratio)) - s.mean() / bulk_modulus;
  }

  /// P [Pa].
  template <class Space>
  double pressure(const Symmetric<Space>& s) const {
    const double p = attraction - s.mean(), least = least_pressure();
    return p < least ? least : p;
  }

 private:
  double least_pressure() const { return 1e-3 * attraction; }

  template <class Space>
  static double deviator(const Symmetric<Space>& s) {
    return std::sqrt(1.5 * s.plus_isotropic(-s.mean()).squared());
  }

  template <class Space>
  [[gnu::always_inline]] Symmetric<Space> elastic(const Symmetric<Space>& old, const GradientIn<Space>& g,
                                                  double dt, double volume) const {
    const double p = pressure(old), bulk = p / swelling;
    const Elasticity shears{shear_ratio * bulk, 2 * shear_ratio * bulk / 3};  // without volume: lambda = 0
    const Symmetric<Space> s = shears.elastic_step(old, g, dt);
    return s.plus_isotropic(attraction - p * exponential(-volume / swelling) - s.mean());
  }

  /// Of a plastic step: q falls by 1 / (1 + shrinkage), P by `fall`, Pc grows by `growth`.
  struct Plastic {
    double multiplier, shrinkage, fall, growth;
  };
  /// One step of Newton's method for f1(u, w) = f2(u, w) = 0, u bounded in its change and w positive.
  struct NewtonStep {
    double u, w, most;
    [[gnu::always_inline]] void take(double f1, double f2, double f1u, double f1w, double f2u, double f2w) {
      const double det = f1u * f2w - f1w * f2u;
      const double per_det = det < 0 ? 1 / det : 0;
      const double du = (f1w * f2 - f1 * f2w) * per_det, dw = (f1 * f2u - f1u * f2) * per_det;
      const double size = du < 0 ? -du : du, share = size > most ? most / size : 1;
      u += share * du;
      const double next = w + share * dw;
      w = next > 0 ? next : 0.5 * w;
    }
  };
  /// Backward Euler in the plastic compression u and the multiplier w, both strains: with E = exp(-u /
  /// kappa*) and C = exp(u / (lambda* - kappa*)), u = w (2 y E - C) and Q^2 / (1 + b w)^2 + y E (y E - C) =
  /// 0, where y = P / Pc, Q = q / (M Pc) (Borja and Lee 1990). Newton's method.
  [[gnu::always_inline]] Plastic returned(double y, double q, double b) const {
    const double hardening = compressibility - swelling, per_k = 1 / swelling, per_h = 1 / hardening;
    const double most = swelling < hardening ? swelling : hardening;
    const double outside = q * q + y * (y - 1);
    // From the state that has not yielded, u = w = 0, where E = C = 1.
    NewtonStep step{0, 0, most};
    step.take(0, outside, 1, 1 - 2 * y, -y * ((2 * y - 1) * per_k + per_h), -2 * b * q * q);
#pragma GCC unroll 16
    for (int k = 0; k < iterations; ++k) {
      const double ye = y * exponential(-step.u * per_k), c = exponential(step.u * per_h);
      const double shrunk = 1 / (1 + b * step.w), qq = q * q * shrunk * shrunk, wet = 2 * ye - c;
      step.take(step.u - step.w * wet, qq + ye * (ye - c), 1 + step.w * (2 * ye * per_k + c * per_h), -wet,
                -ye * (wet * per_k + c * per_h), -2 * b * qq * shrunk);
    }
    const bool yields = outside > 0;
    const double u = step.u, w = step.w;
    return {yields ? w : 0, yields ? b * w : 0, yields ? exponential(-u * per_k) : 1,
            yields ? exponential(u * per_h) : 1};
  }
  static constexpr int iterations = 9;
};
static_assert(YieldingLaw<CamClay>);

}  // namespace porosph
