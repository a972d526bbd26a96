// Small tensors of the space that the soil is computed in.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>  // determinant

namespace porosph {

/// Plane strain: nothing moves out of the plane, but the stress zz is kept.
struct Plane {
  static constexpr int dim = 2;
};
/// Rotation about the y axis: x is the radius, zz the hoop direction, which strains by v_x / x.
struct Axisymmetric {
  static constexpr int dim = 2;
};
struct Solid {
  static constexpr int dim = 3;
};

template <class Space>
using VectorIn = Eigen::Matrix<double, Space::dim, 1>;
template <class Space>
using MatrixIn = Eigen::Matrix<double, Space::dim, Space::dim>;

/// Symmetric tensor: a stress [Pa], tension positive, or a strain. Plain numbers, so that loops over it
/// become vector code.
template <class Space>
struct Symmetric {
  double xx = 0, yy = 0, zz = 0, xy = 0;

  double trace() const { return xx + yy + zz; }
  double mean() const { return (xx + yy + zz) / 3; }
  MatrixIn<Plane> in_plane() const { return (MatrixIn<Plane>() << xx, xy, xy, yy).finished(); }
  Symmetric operator+(const Symmetric& o) const { return {xx + o.xx, yy + o.yy, zz + o.zz, xy + o.xy}; }
  Symmetric operator*(double s) const { return {xx * s, yy * s, zz * s, xy * s}; }
  Symmetric plus_isotropic(double p) const { return {xx + p, yy + p, zz + p, xy}; }
  /// s : s.
  double squared() const { return xx * xx + yy * yy + zz * zz + 2 * xy * xy; }
};

template <>
struct Symmetric<Solid> {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;

  double trace() const { return xx + yy + zz; }
  double mean() const { return (xx + yy + zz) / 3; }
  Symmetric operator+(const Symmetric& o) const {
    return {xx + o.xx, yy + o.yy, zz + o.zz, xy + o.xy, yz + o.yz, xz + o.xz};
  }
  Symmetric operator*(double s) const { return {xx * s, yy * s, zz * s, xy * s, yz * s, xz * s}; }
  Symmetric plus_isotropic(double p) const { return {xx + p, yy + p, zz + p, xy, yz, xz}; }
  double squared() const { return xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + xz * xz); }
};

/// Gradient of a vector field, d(first)/d(second).
template <class Space>
struct GradientIn;

template <>
struct GradientIn<Plane> {
  double xx = 0, xy = 0, yx = 0, yy = 0;

  GradientIn() = default;
  GradientIn(double a, double b, double c, double d) : xx(a), xy(b), yx(c), yy(d) {}
  template <class Derived>
  GradientIn(const Eigen::MatrixBase<Derived>& m) : xx(m(0, 0)), xy(m(0, 1)), yx(m(1, 0)), yy(m(1, 1)) {}
  double trace() const { return xx + yy; }
  static constexpr double zz = 0;
};

template <>
struct GradientIn<Axisymmetric> {
  double xx = 0, xy = 0, yx = 0, yy = 0;
  double zz = 0;  ///< v_x / x

  double trace() const { return xx + yy + zz; }
};

template <>
struct GradientIn<Solid> {
  double xx = 0, xy = 0, xz = 0, yx = 0, yy = 0, yz = 0, zx = 0, zy = 0, zz = 0;

  double trace() const { return xx + yy + zz; }
};

using Vec2 = VectorIn<Plane>;
using Mat2 = MatrixIn<Plane>;
using Vec3 = VectorIn<Solid>;
using Mat3 = MatrixIn<Solid>;
using Stress = Symmetric<Plane>;
using Gradient = GradientIn<Plane>;

/// Inverse of a 2 x 2 matrix; the caller guarantees that it is regular.
inline Mat2 inverse(const Mat2& m) {
  const double d = 1 / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
  return (Mat2() << m(1, 1) * d, -m(0, 1) * d, -m(1, 0) * d, m(0, 0) * d).finished();
}

}  // namespace porosph
