// A particle's small matrices in each space. Written out in plain numbers, so that loops over particles
// become vector code. For the kernels only, which are compiled for each kind of vector units.
#pragma once

#include <cmath>
#include <cstdint>

#include "solver/sph/kernels/consistent_kernels.hpp"

namespace porosph::POROSPH_VECTOR_UNITS {
namespace {

/// A matrix of the space's coordinates, without a hoop.
template <class Space>
using MatrixOf = GradientIn<std::conditional_t<Space::dim == 3, Solid, Plane>>;

/// By value: std::max keeps the loop from becoming vector code.
inline double larger(double a, double b) { return a > b ? a : b; }

/// Entry i of `numbers`, one array each.
template <class Space>
[[gnu::always_inline]] inline GradientIn<Space> gradient_at(const double* const* numbers, std::int32_t i) {
  if constexpr (Space::dim == 3)
    return {numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i], numbers[4][i],
            numbers[5][i], numbers[6][i], numbers[7][i], numbers[8][i]};
  else if constexpr (has_hoop<Space>)
    return {numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i], numbers[4][i]};
  else
    return {numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i]};
}
template <class Space>
[[gnu::always_inline]] inline MatrixOf<Space> matrix_at(const double* const* numbers, std::int32_t i) {
  if constexpr (Space::dim == 3)
    return gradient_at<Solid>(numbers, i);
  else
    return gradient_at<Plane>(numbers, i);
}

[[gnu::always_inline]] inline void put(double* const* numbers, std::int32_t i, const Gradient& g) {
  numbers[0][i] = g.xx, numbers[1][i] = g.xy, numbers[2][i] = g.yx, numbers[3][i] = g.yy;
}
[[gnu::always_inline]] inline void put(double* const* numbers, std::int32_t i,
                                       const GradientIn<Axisymmetric>& g) {
  numbers[0][i] = g.xx, numbers[1][i] = g.xy, numbers[2][i] = g.yx, numbers[3][i] = g.yy;
  numbers[4][i] = g.zz;
}
[[gnu::always_inline]] inline void put(double* const* numbers, std::int32_t i, const GradientIn<Solid>& g) {
  numbers[0][i] = g.xx, numbers[1][i] = g.xy, numbers[2][i] = g.xz;
  numbers[3][i] = g.yx, numbers[4][i] = g.yy, numbers[5][i] = g.yz;
  numbers[6][i] = g.zx, numbers[7][i] = g.zy, numbers[8][i] = g.zz;
}

/// Without the hoop's number.
[[gnu::always_inline]] inline Gradient matrix_of(const Gradient& g) { return g; }
[[gnu::always_inline]] inline GradientIn<Solid> matrix_of(const GradientIn<Solid>& g) { return g; }
[[gnu::always_inline]] inline Gradient matrix_of(const GradientIn<Axisymmetric>& g) {
  return {g.xx, g.xy, g.yx, g.yy};
}

/// a + s b.
inline Gradient plus(const Gradient& a, double s, const Gradient& b) {
  return {a.xx + s * b.xx, a.xy + s * b.xy, a.yx + s * b.yx, a.yy + s * b.yy};
}
inline GradientIn<Axisymmetric> plus(const GradientIn<Axisymmetric>& a, double s,
                                     const GradientIn<Axisymmetric>& b) {
  return {a.xx + s * b.xx, a.xy + s * b.xy, a.yx + s * b.yx, a.yy + s * b.yy, a.zz + s * b.zz};
}
inline GradientIn<Solid> plus(const GradientIn<Solid>& a, double s, const GradientIn<Solid>& b) {
  return {a.xx + s * b.xx, a.xy + s * b.xy, a.xz + s * b.xz, a.yx + s * b.yx, a.yy + s * b.yy,
          a.yz + s * b.yz, a.zx + s * b.zx, a.zy + s * b.zy, a.zz + s * b.zz};
}

/// a - s b.
inline Gradient less(const Gradient& a, double s, const Gradient& b) {
  return {a.xx - s * b.xx, a.xy - s * b.xy, a.yx - s * b.yx, a.yy - s * b.yy};
}
inline GradientIn<Solid> less(const GradientIn<Solid>& a, double s, const GradientIn<Solid>& b) {
  return plus(a, -s, b);
}

/// a + s (b - I).
inline Gradient plus_strain(const Gradient& a, double s, const Gradient& b) {
  return {a.xx + s * (b.xx - 1), a.xy + s * b.xy, a.yx + s * b.yx, a.yy + s * (b.yy - 1)};
}
inline GradientIn<Solid> plus_strain(const GradientIn<Solid>& a, double s, const GradientIn<Solid>& b) {
  return {a.xx + s * (b.xx - 1), a.xy + s * b.xy,       a.xz + s * b.xz,
          a.yx + s * b.yx,       a.yy + s * (b.yy - 1), a.yz + s * b.yz,
          a.zx + s * b.zx,       a.zy + s * b.zy,       a.zz + s * (b.zz - 1)};
}

/// Largest number of |F - I|.
inline double largest_strain(const Gradient& f) {
  return larger(larger(std::abs(f.xx - 1), std::abs(f.yy - 1)), larger(std::abs(f.xy), std::abs(f.yx)));
}
inline double largest_strain(const GradientIn<Axisymmetric>& f) {
  return larger(largest_strain(matrix_of(f)), std::abs(f.zz - 1));
}
inline double largest_strain(const GradientIn<Solid>& f) {
  const double out = larger(std::abs(f.zz - 1), larger(larger(std::abs(f.xz), std::abs(f.zx)),
                                                       larger(std::abs(f.yz), std::abs(f.zy))));
  return larger(largest_strain(Gradient(f.xx, f.xy, f.yx, f.yy)), out);
}

inline double determinant(const Gradient& f) { return f.xx * f.yy - f.xy * f.yx; }
inline double determinant(const GradientIn<Axisymmetric>& f) { return determinant(matrix_of(f)) * f.zz; }
inline double determinant(const GradientIn<Solid>& f) {
  return f.xx * (f.yy * f.zz - f.yz * f.zy) + f.xy * (f.yz * f.zx - f.yx * f.zz) +
         f.xz * (f.yx * f.zy - f.yy * f.zx);
}
/// J F^-T.
inline GradientIn<Solid> cofactor(const GradientIn<Solid>& f) {
  return {f.yy * f.zz - f.yz * f.zy, f.yz * f.zx - f.yx * f.zz, f.yx * f.zy - f.yy * f.zx,
          f.xz * f.zy - f.xy * f.zz, f.xx * f.zz - f.xz * f.zx, f.xy * f.zx - f.xx * f.zy,
          f.xy * f.yz - f.xz * f.yy, f.xz * f.yx - f.xx * f.yz, f.xx * f.yy - f.xy * f.yx};
}

/// a b, of matrices without a hoop.
inline Gradient product(const Gradient& a, const Gradient& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy};
}
inline GradientIn<Solid> product(const GradientIn<Solid>& a, const GradientIn<Solid>& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
inline Gradient transposed(const Gradient& m) { return {m.xx, m.yx, m.xy, m.yy}; }
inline GradientIn<Solid> transposed(const GradientIn<Solid>& m) {
  return {m.xx, m.yx, m.zx, m.xy, m.yy, m.zy, m.xz, m.yz, m.zz};
}
inline Gradient scaled(double s, const Gradient& m) { return {s * m.xx, s * m.xy, s * m.yx, s * m.yy}; }
inline GradientIn<Solid> scaled(double s, const GradientIn<Solid>& m) {
  return {s * m.xx, s * m.xy, s * m.xz, s * m.yx, s * m.yy, s * m.yz, s * m.zx, s * m.zy, s * m.zz};
}

/// P = J t F^-T of the Cauchy stress t.
inline Gradient first_piola(const Stress& t, const Gradient& f) {
  return {t.xx * f.yy - t.xy * f.xy, t.xy * f.xx - t.xx * f.yx, t.xy * f.yy - t.yy * f.xy,
          t.yy * f.xx - t.xy * f.yx};
}
inline GradientIn<Axisymmetric> first_piola(const Symmetric<Axisymmetric>& t,
                                            const GradientIn<Axisymmetric>& f) {
  const Gradient p = scaled(f.zz, first_piola(Stress{t.xx, t.yy, t.zz, t.xy}, matrix_of(f)));
  return {p.xx, p.xy, p.yx, p.yy, t.zz * determinant(matrix_of(f))};
}
inline GradientIn<Solid> first_piola(const Symmetric<Solid>& t, const GradientIn<Solid>& f) {
  return product({t.xx, t.xy, t.xz, t.xy, t.yy, t.yz, t.xz, t.yz, t.zz}, cofactor(f));
}

/// Power s : D per volume of a stress [W/m3].
inline double power(const Stress& s, const Gradient& g) {
  return s.xx * g.xx + s.yy * g.yy + s.xy * (g.xy + g.yx);
}
inline double power(const Symmetric<Axisymmetric>& s, const GradientIn<Axisymmetric>& g) {
  return s.xx * g.xx + s.yy * g.yy + s.xy * (g.xy + g.yx) + s.zz * g.zz;
}
inline double power(const Symmetric<Solid>& s, const GradientIn<Solid>& g) {
  return s.xx * g.xx + s.yy * g.yy + s.zz * g.zz + s.xy * (g.xy + g.yx) + s.yz * (g.yz + g.zy) +
         s.xz * (g.xz + g.zx);
}

/// gamma = sqrt(2 D : D) of the deviator of D, in the plane that of its own two directions [1/s].
inline double shear_rate_of(const Gradient& g) {
  const double stretch = g.xx - g.yy, slip = g.xy + g.yx;
  return std::sqrt(stretch * stretch + slip * slip);
}
inline double shear_rate_of(const GradientIn<Axisymmetric>& g) {
  const double a = g.xx - g.yy, b = g.yy - g.zz, c = g.zz - g.xx, slip = g.xy + g.yx;
  return std::sqrt(2.0 / 3 * (a * a + b * b + c * c) + slip * slip);
}
inline double shear_rate_of(const GradientIn<Solid>& g) {
  const double a = g.xx - g.yy, b = g.yy - g.zz, c = g.zz - g.xx;
  const double xy = g.xy + g.yx, yz = g.yz + g.zy, xz = g.xz + g.zx;
  return std::sqrt(2.0 / 3 * (a * a + b * b + c * c) + xy * xy + yz * yz + xz * xz);
}

/// Sum of absolute values.
inline double size_of(const Stress& s) { return std::abs(s.xx) + std::abs(s.yy) + std::abs(s.xy); }
inline double size_of(const Symmetric<Axisymmetric>& s) {
  return std::abs(s.xx) + std::abs(s.yy) + std::abs(s.zz) + std::abs(s.xy);
}
inline double size_of(const Symmetric<Solid>& s) {
  return std::abs(s.xx) + std::abs(s.yy) + std::abs(s.zz) + std::abs(s.xy) + std::abs(s.yz) + std::abs(s.xz);
}

}  // namespace
}  // namespace porosph::POROSPH_VECTOR_UNITS
