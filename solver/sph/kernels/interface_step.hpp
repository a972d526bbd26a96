// What the material step does where another soil is near, in the plane. For the kernels only, which are
// compiled for each kind of vector units.
#pragma once

#include "solver/sph/kernels/material_step.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// What a step at an interface does with the gradient of a particle's own side.
struct OwnSideStep {
  OwnSideStep(const ConsistentArrays& c, std::int32_t first_particle, std::int32_t place)
      : interface_stress(c.state.interface_stress + first_particle),
        along_x(c.state.own_sides.along[0] + place),
        along_y(c.state.own_sides.along[1] + place),
        elastic(c.state.own_sides.rate + place) {
    for (int k = 0; k < 16; ++k) a[k] = c.state.own_sides.gradient[k] + place;
    for (int k = 0; k < 4; ++k) tie[k] = c.state.own_sides.tie[k] + place;
  }

  /// A : m for the particle j of this stretch.
  [[gnu::always_inline]] Gradient own(std::int32_t j, double mxx, double mxy, double myx, double myy) const {
    return {a[0][j] * mxx + a[1][j] * mxy + a[2][j] * myx + a[3][j] * myy,
            a[4][j] * mxx + a[5][j] * mxy + a[6][j] * myx + a[7][j] * myy,
            a[8][j] * mxx + a[9][j] * mxy + a[10][j] * myx + a[11][j] * myy,
            a[12][j] * mxx + a[13][j] * mxy + a[14][j] * myx + a[15][j] * myy};
  }
  /// The own side's strain rate with the rotation of the sum.
  [[gnu::always_inline]] Gradient gradient(std::int32_t j, const Gradient& summed) const {
    const Gradient g = own(j, summed.xx, summed.xy, summed.yx, summed.yy);
    const double shear = 0.5 * (g.xy + g.yx), spin = 0.5 * (summed.yx - summed.xy);
    return {g.xx, shear - spin, shear + spin, g.yy};
  }
  /// Carries tau over the step and adds tau t (x) t to the stress. Soil that yields does not hold it: half of
  /// it goes in each step.
  [[gnu::always_inline]] Stress tied(std::int32_t j, const Stress& s, const Gradient& g, double dt,
                                     double yields) const {
    const double grown = dt * (tie[0][j] * g.xx + tie[1][j] * g.xy + tie[2][j] * g.yx + tie[3][j] * g.yy);
    const double tau = (1 - 0.5 * yields) * interface_stress[j] + (1 - yields) * grown;
    interface_stress[j] = tau;
    const double x = along_x[j], y = along_y[j];
    return {s.xx + tau * x * x, s.yy + tau * y * y, s.zz, s.xy + tau * x * y};
  }
  /// What the zero-energy control acts on at particle i of the tile.
  [[gnu::always_inline]] Gradient controlled(const TileStep<Plane>& t, std::int32_t i, std::int32_t j,
                                             const Gradient& f) const {
    const Gradient c = t.controlled(i, f, elastic[j]);
    return own(j, c.xx, c.xy, c.yx, c.yy);
  }

  double* interface_stress;
  const double *along_x, *along_y, *elastic;
  const double *a[16], *tie[4];
};

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
