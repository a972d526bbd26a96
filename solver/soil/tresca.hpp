// Tresca's soil: undrained clay, with a shear strength that does not depend on pressure.
#pragma once

#include "solver/soil/mohr_coulomb.hpp"

namespace porosph {

/// (s1 - s3) / 2 <= c_u, flow without change of volume. c_u may grow with depth: each particle remembers its
/// own. With plastic strain it may fall to a share of that.
struct Tresca : Elasticity {
  struct History {
    double plastic_strain = 0;
    double undrained_strength = 0;  ///< before softening and reduction [Pa]
    double opening = 0;
  };
  static constexpr std::array<Field, 3> history{law_fields::plastic_strain, law_fields::undrained_strength,
                                                law_fields::opening};

  double strength = 0;                                  ///< c_u at the level and above [Pa]
  double growth = 0;                                    ///< below it, with depth [Pa/m]
  double level = 0;                                     ///< y [m]
  double reduction = 1;                                 ///< c_u over that of the particle
  double tension = std::numeric_limits<double>::max();  ///< most principal tension [Pa]
  Softening softening = {};
  double residual = 1;  ///< share of c_u that softening leaves

  History at_start(const Vec2& position) const {
    const double depth = level - position.y();
    return {0, strength + (depth > 0 ? growth * depth : 0), 0};
  }

  double undrained_strength(const History& q) const {
    return reduction * q.undrained_strength * (residual + (1 - residual) * softening.left(q.plastic_strain));
  }
  /// Radius of the largest circle, and the most that the law bears [Pa].
  template <HasPrincipalPlane Space>
  double shear_stress(const Symmetric<Space>& s) const {
    return LargestCircle<Space>(s).radius;
  }
  template <HasPrincipalPlane Space>
  double shear_strength(const Symmetric<Space>&, const History& q) const {
    return undrained_strength(q);
  }
  double sin_friction(const History&) const { return 0; }

  template <HasPrincipalPlane Space>
  [[gnu::always_inline]] Symmetric<Space> step(const Symmetric<Space>& old,
                                               const GradientIn<Space>& velocity_gradient, double dt,
                                               History& q) const {
    const auto [trial, shut] = closing_step(old, velocity_gradient, dt, q.opening);
    const MohrCoulombSurface now{0, undrained_strength(q), 0, tension};
    const ReturnedInPlane r = returned_in_plane(trial.xx, trial.yy, trial.zz, trial.xy, now, *this);
    q.plastic_strain += r.plastic_strain;
    q.opening += r.opening - shut;
    return {r.xx, r.yy, r.zz, r.xy};
  }
};
static_assert(YieldingLaw<Tresca>);

}  // namespace porosph
