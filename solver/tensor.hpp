// Small tensors of plane strain.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>  // determinant

namespace porosph {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// Symmetric stress in plane strain, tension positive [Pa]. zz does not act in the plane but is kept.
struct Stress {
  double xx = 0, yy = 0, zz = 0, xy = 0;

  double mean() const { return (xx + yy + zz) / 3; }
  Mat2 in_plane() const { return (Mat2() << xx, xy, xy, yy).finished(); }
  Stress operator+(const Stress& o) const { return {xx + o.xx, yy + o.yy, zz + o.zz, xy + o.xy}; }
  Stress operator*(double s) const { return {xx * s, yy * s, zz * s, xy * s}; }
};

/// Gradient of a plane vector field, d(first)/d(second). Plain numbers, so that loops over it become vector
/// code.
struct Gradient {
  double xx = 0, xy = 0, yx = 0, yy = 0;

  Gradient() = default;
  Gradient(double a, double b, double c, double d) : xx(a), xy(b), yx(c), yy(d) {}
  template <class Derived>
  Gradient(const Eigen::MatrixBase<Derived>& m) : xx(m(0, 0)), xy(m(0, 1)), yx(m(1, 0)), yy(m(1, 1)) {}
  double trace() const { return xx + yy; }
};

/// Inverse of a 2 x 2 matrix; the caller guarantees that it is regular.
inline Mat2 inverse(const Mat2& m) {
  const double d = 1 / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
  return (Mat2() << m(1, 1) * d, -m(0, 1) * d, -m(1, 0) * d, m(0, 0) * d).finished();
}

}  // namespace porosph
