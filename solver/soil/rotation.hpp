// The rotation of a step (Hughes and Winget 1980), exact for a rigid rotation.
#pragma once

#include "solver/space/tensor.hpp"

namespace porosph {

/// In the plane: stress turned counter-clockwise by the angle whose half has the tangent t.
template <class Space>
inline Symmetric<Space> turned_in_plane(const Symmetric<Space>& s, double t) {
  const double scale = 1 / (1 + t * t), c = (1 - t * t) * scale, sn = 2 * t * scale;
  const double shear = 2 * c * sn * s.xy;
  return {c * c * s.xx + sn * sn * s.yy - shear, sn * sn * s.xx + c * c * s.yy + shear, s.zz,
          c * sn * (s.xx - s.yy) + (c * c - sn * sn) * s.xy};
}

/// Stress turned by the rotation of a step dt [s], omega of eq. (31) from the velocity gradient at the middle
/// of the step [1/s].
template <class Space>
inline Symmetric<Space> turned(const Symmetric<Space>& s, const GradientIn<Space>& g, double dt) {
  const double spin = 0.5 * (g.yx - g.xy);
  return turned_in_plane(s, 0.5 * spin * dt);
}

/// In space: with t the tangent of half the angle along the axis, R v = v + 2 / (1 + t^2) (t x v + t x (t x
/// v)).
inline Symmetric<Solid> turned(const Symmetric<Solid>& s, const GradientIn<Solid>& g, double dt) {
  // A quarter of dt curl v.
  const double tx = 0.25 * dt * (g.zy - g.yz), ty = 0.25 * dt * (g.xz - g.zx), tz = 0.25 * dt * (g.yx - g.xy);
  const double k = 2 / (1 + tx * tx + ty * ty + tz * tz);
  const double rxx = 1 - k * (ty * ty + tz * tz), rxy = k * (tx * ty - tz), rxz = k * (tx * tz + ty);
  const double ryx = k * (tx * ty + tz), ryy = 1 - k * (tx * tx + tz * tz), ryz = k * (ty * tz - tx);
  const double rzx = k * (tx * tz - ty), rzy = k * (ty * tz + tx), rzz = 1 - k * (tx * tx + ty * ty);
  // The rows of R s.
  const double axx = rxx * s.xx + rxy * s.xy + rxz * s.xz, axy = rxx * s.xy + rxy * s.yy + rxz * s.yz,
               axz = rxx * s.xz + rxy * s.yz + rxz * s.zz;
  const double ayx = ryx * s.xx + ryy * s.xy + ryz * s.xz, ayy = ryx * s.xy + ryy * s.yy + ryz * s.yz,
               ayz = ryx * s.xz + ryy * s.yz + ryz * s.zz;
  const double azx = rzx * s.xx + rzy * s.xy + rzz * s.xz, azy = rzx * s.xy + rzy * s.yy + rzz * s.yz,
               azz = rzx * s.xz + rzy * s.yz + rzz * s.zz;
  return {axx * rxx + axy * rxy + axz * rxz, ayx * ryx + ayy * ryy + ayz * ryz,
          azx * rzx + azy * rzy + azz * rzz, axx * ryx + axy * ryy + axz * ryz,
          ayx * rzx + ayy * rzy + ayz * rzz, axx * rzx + axy * rzy + axz * rzz};
}

}  // namespace porosph
