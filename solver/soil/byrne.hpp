// Byrne's sand: Mohr and Coulomb's soil that cycles of shear compact.
#pragma once

#include "solver/soil/mohr_coulomb.hpp"

namespace porosph {

/// A half-cycle of the shear strain gamma = 2 e_xy, from one turning point to the next, compacts the soil by
///
///   d e_vd = c1 gamma_a exp(-c2 e_vd / gamma_a) / 2
///
/// with gamma_a half of the way between them and e_vd what there is of compaction (Byrne 1991: twice that for
/// a cycle). It is a plastic strain without direction: where the volume is held, the mean effective stress
/// falls by K d e_vd. A turning point counts once the strain has come back from it by twice `threshold`, so
/// smaller cycles compact nothing.
struct Byrne : MohrCoulomb {
  struct History : MohrCoulomb::History {
    double compaction = 0;                     ///< e_vd
    double shear = 0;                          ///< gamma
    double turned_at = 0, farthest_since = 0;  ///< of gamma
  };
  static constexpr std::array<Field, 7> history{law_fields::plastic_strain, law_fields::opening,
                                                law_fields::dilation,       law_fields::compaction,
                                                law_fields::cyclic_strain,  law_fields::turning_strain,
                                                law_fields::farthest_strain};

  double c1 = 0, c2 = 0, threshold = 0;

  template <HasPrincipalPlane Space>
  [[gnu::always_inline]] Symmetric<Space> step(const Symmetric<Space>& old,
                                               const GradientIn<Space>& velocity_gradient, double dt,
                                               History& q) const {
    const double compacted = compact(q, q.shear + (velocity_gradient.xy + velocity_gradient.yx) * dt);
    return MohrCoulomb::step(old.plus_isotropic(bulk_modulus * compacted), velocity_gradient, dt, q);
  }

  /// Goes on to a shear strain; returns d e_vd where that ends a half-cycle, or else 0.
  [[gnu::always_inline]] double compact(History& q, double shear) const {
    const double upper = shear > q.farthest_since ? shear : q.farthest_since;
    const double lower = shear < q.farthest_since ? shear : q.farthest_since;
    const double farthest = q.farthest_since >= q.turned_at ? upper : lower;
    const bool turns = std::abs(shear - farthest) > 2 * threshold;
    const double amplitude = 0.5 * std::abs(farthest - q.turned_at), counted = turns ? amplitude : 0;
    const double compacted = 0.5 * c1 * counted * decay(c2 * q.compaction / (amplitude > 0 ? amplitude : 1));
    q.compaction += compacted;
    q.shear = shear;
    q.turned_at = turns ? farthest : q.turned_at;
    q.farthest_since = turns ? shear : farthest;
    return compacted;
  }
};
static_assert(YieldingLaw<Byrne>);

}  // namespace porosph
