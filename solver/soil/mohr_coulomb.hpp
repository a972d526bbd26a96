// Mohr and Coulomb's soil: elastic and plastic, with friction, cohesion, dilation and a tension cut-off.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/soil/elasticity.hpp"
#include "solver/soil/law.hpp"
#include "solver/soil/law_fields.hpp"
#include "solver/soil/softening.hpp"

namespace porosph {

/// s1 - s3 + (s1 + s3) sin(phi) <= 2 c cos(phi) and s1 <= tension, with principal stresses s1 >= s2 >= s3.
struct MohrCoulombSurface {
  double sin_phi, c_cos_phi;  ///< [-], [Pa]
  double sin_psi;             ///< of the dilation angle
  double tension;             ///< [Pa]

  double apex() const { return sin_phi > 1e-9 ? c_cos_phi / sin_phi : std::numeric_limits<double>::max(); }
};

/// Principal stresses, largest first [Pa].
struct PrincipalStress {
  double s1, s2, s3;
};

/// What a return to the surface does.
struct Returned {
  PrincipalStress stress;
  double plastic_strain;  ///< sqrt(2/3 de : de), e deviatoric
  double opening;         ///< volume strain at the apex and across the tension cut-off
  double dilation;        ///< volume strain of what led there
};

/// Principal stresses of an elastic step, returned to the surface along the plastic potential: to the plane,
/// to the edge where two principal stresses are equal, or to the apex (Clausen, Damkilde and Andersen 2006).
/// Elasticity is linear, so each is in closed form; what does not hold is not selected.
[[gnu::always_inline]] inline Returned returned(const PrincipalStress& a, const MohrCoulombSurface& m,
                                                const Elasticity& e) {
  const double lambda = e.bulk_modulus - 2 * e.shear_modulus / 3, g2 = 2 * e.shear_modulus;
  const double plus = 1 + m.sin_phi, minus = 1 - m.sin_phi;
  // D n of a plane's potential: in the larger stress, in the one that it leaves out, in the smaller.
  const double out = 2 * lambda * m.sin_psi, up = out + g2 * (1 + m.sin_psi),
               down = out - g2 * (1 - m.sin_psi);
  const double excess = plus * a.s1 - minus * a.s3 - 2 * m.c_cos_phi, f = excess > 0 ? excess : 0;
  const double slope = plus * up - minus * down;
  const double g = f / slope;
  const double p1 = a.s1 - g * up, p2 = a.s2 - g * out, p3 = a.s3 - g * down;
  // The second plane meets the first where s1 = s2 (it bounds s2 - s3), or where s2 = s3 (s1 - s2).
  const bool upper = p2 > p1, edge = upper || p2 < p3;
  const double f2 = (upper ? plus * a.s2 - minus * a.s3 : plus * a.s1 - minus * a.s2) - 2 * m.c_cos_phi;
  const double cross = upper ? plus * out - minus * down : plus * up - minus * out;
  const double per_det = 1 / (slope * slope - cross * cross);
  const double g1 = (f * slope - cross * f2) * per_det, g2nd = (f2 * slope - cross * f) * per_det;
  const double e1 = a.s1 - g1 * up - g2nd * (upper ? out : up);
  const double e2 = a.s2 - g1 * out - g2nd * (upper ? up : down);
  const double e3 = a.s3 - g1 * down - g2nd * (upper ? down : out);
  double b1 = edge ? e1 : p1, b2 = edge ? e2 : p2, b3 = edge ? e3 : p3;
  const double mean = (b1 + b2 + b3) / 3, apex = m.apex();
  const bool at_apex = mean > apex || b1 > apex;
  const double dilation = ((a.s1 + a.s2 + a.s3) / 3 - mean) / e.bulk_modulus;
  const double at_tip = at_apex ? mean - apex : 0;
  b1 = at_apex ? apex : b1, b2 = at_apex ? apex : b2, b3 = at_apex ? apex : b3;
  const double uncut = b1 + b2 + b3;
  // Across the cut-off the soil opens along s1, until s1 and s3 are on the surface together.
  const double cut = b1 > m.tension ? b1 - m.tension : 0, along = cut * lambda / (lambda + g2);
  const double corner = (plus * m.tension - 2 * m.c_cos_phi) / minus, least = b3 < corner ? b3 : corner;
  const double lowered3 = b3 - along > least ? b3 - along : least;
  const double lowered2 = b2 - along > lowered3 ? b2 - along : lowered3;
  b1 -= cut;
  b2 = cut > 0 ? (lowered2 < b1 ? lowered2 : b1) : b2;
  b3 = cut > 0 ? (lowered3 < b1 ? lowered3 : b1) : b3;
  const double opening = (at_tip + (uncut - b1 - b2 - b3) / 3) / e.bulk_modulus;
  const double d1 = a.s1 - b1, d2 = a.s2 - b2, d3 = a.s3 - b3, third = (d1 + d2 + d3) / 3;
  const double squared =
      (d1 - third) * (d1 - third) + (d2 - third) * (d2 - third) + (d3 - third) * (d3 - third);
  return {{b1, b2, b3}, std::sqrt(2.0 / 3 * squared) / g2, opening, dilation};
}

/// The same of a stress whose zz is principal.
struct ReturnedInPlane {
  double xx, yy, zz, xy;  ///< [Pa]
  double plastic_strain, opening, dilation;
};
[[gnu::always_inline]] inline ReturnedInPlane returned_in_plane(double xx, double yy, double zz, double xy,
                                                                const MohrCoulombSurface& m,
                                                                const Elasticity& e) {
  const double centre = 0.5 * (xx + yy), half = 0.5 * (xx - yy), radius = std::sqrt(half * half + xy * xy);
  const double p = centre + radius, q = centre - radius;
  const bool above = zz > p, below = zz < q;
  const PrincipalStress trial{above ? zz : p, above ? p : below ? q : zz, below ? zz : q};
  const bool yields =
      (1 + m.sin_phi) * trial.s1 - (1 - m.sin_phi) * trial.s3 > 2 * m.c_cos_phi || trial.s1 > m.tension;
  const Returned r = returned(trial, m, e);
  const double new_p = above ? r.stress.s2 : r.stress.s1, new_q = below ? r.stress.s2 : r.stress.s3;
  const double new_zz = above ? r.stress.s1 : below ? r.stress.s3 : r.stress.s2;
  const double new_centre = 0.5 * (new_p + new_q), new_radius = 0.5 * (new_p - new_q);
  const double scale = radius > 0 ? new_radius / radius : 0;
  return {yields ? new_centre + scale * half : xx,
          yields ? new_centre - scale * half : yy,
          yields ? new_zz : zz,
          yields ? scale * xy : xy,
          yields ? r.plastic_strain : 0,
          yields ? r.opening : 0,
          yields ? r.dilation : 0};
}

/// A space in which zz is a principal stress.
template <class Space>
concept HasPrincipalPlane = Space::dim == 2;

/// Largest minus smallest principal stress, halved: the radius of the largest circle [Pa]; and its middle.
template <HasPrincipalPlane Space>
struct LargestCircle {
  explicit LargestCircle(const Symmetric<Space>& s) {
    const double centre = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
    const double r = std::sqrt(half * half + s.xy * s.xy), p = centre + r, q = centre - r;
    const double most = s.zz > p ? s.zz : p, least = s.zz < q ? s.zz : q;
    radius = 0.5 * (most - least), middle = 0.5 * (most + least);
  }
  double radius, middle;
};

/// With plastic strain, c cos(phi), sin(phi) and sin(psi) may fall to their residual values. Dilation ends at
/// a volume strain.
struct MohrCoulomb : Elasticity {
  struct History {
    double plastic_strain = 0;
    double opening = 0;
    double dilation = 0;
  };
  static constexpr std::array<Field, 3> history{law_fields::plastic_strain, law_fields::opening,
                                                law_fields::dilation};

  double sin_phi = 0, c_cos_phi = 0, sin_psi = 0;       ///< [-], [Pa], [-]
  double tension = std::numeric_limits<double>::max();  ///< most principal tension [Pa]
  double dilation_limit =
      std::numeric_limits<double>::max();  ///< volume strain of plastic flow at which dilation ends
  Softening softening = {};
  double residual_sin_phi = 0, residual_c_cos_phi = 0;  ///< of no use without softening

  /// Cohesion [Pa], friction and dilation angle [degrees], most principal tension [Pa].
  static MohrCoulomb from_angles(const Elasticity& elastic, double cohesion, double friction,
                                 double dilation = 0, double tension = std::numeric_limits<double>::max()) {
    const double radian = std::numbers::pi / 180;
    MohrCoulomb law{elastic};
    law.sin_phi = std::sin(friction * radian), law.c_cos_phi = cohesion * std::cos(friction * radian);
    law.sin_psi = std::sin(dilation * radian);
    law.tension = tension;
    return law;
  }
  /// The same, softening to a residual cohesion [Pa] and friction angle [degrees] without dilation.
  MohrCoulomb softened_to(double cohesion, double friction, Softening by) const {
    const MohrCoulomb residual = from_angles(*this, cohesion, friction);
    MohrCoulomb law = *this;
    law.softening = by;
    law.residual_sin_phi = residual.sin_phi, law.residual_c_cos_phi = residual.c_cos_phi;
    return law;
  }

  MohrCoulombSurface surface(const History& q) const {
    const double left = softening.left(q.plastic_strain);
    return {residual_sin_phi + (sin_phi - residual_sin_phi) * left,
            residual_c_cos_phi + (c_cos_phi - residual_c_cos_phi) * left,
            q.dilation < dilation_limit ? sin_psi * left : 0, tension};
  }
  /// Radius of the largest circle, and the most that the law bears around its middle [Pa].
  template <HasPrincipalPlane Space>
  double shear_stress(const Symmetric<Space>& s) const {
    return LargestCircle<Space>(s).radius;
  }
  template <HasPrincipalPlane Space>
  double shear_strength(const Symmetric<Space>& s, const History& q) const {
    const MohrCoulombSurface now = surface(q);
    return now.c_cos_phi - now.sin_phi * LargestCircle<Space>(s).middle;
  }
  double sin_friction(const History& q) const { return surface(q).sin_phi; }

  template <HasPrincipalPlane Space>
  [[gnu::always_inline]] Symmetric<Space> step(const Symmetric<Space>& old,
                                               const GradientIn<Space>& velocity_gradient, double dt,
                                               History& q) const {
    const auto [trial, shut] = closing_step(old, velocity_gradient, dt, q.opening);
    const ReturnedInPlane r = returned_in_plane(trial.xx, trial.yy, trial.zz, trial.xy, surface(q), *this);
    q.plastic_strain += r.plastic_strain;
    q.opening += r.opening - shut;
    q.dilation += r.dilation;
    return {r.xx, r.yy, r.zz, r.xy};
  }
};
static_assert(YieldingLaw<MohrCoulomb>);

}  // namespace porosph
