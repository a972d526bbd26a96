#include "solver/boundary/support.hpp"

namespace porosph {
namespace {

/// Nothing moves across it; the soil slides along it, and friction is added to its stress (WallFriction).
class Roller final : public Support {
 public:
  Mat2 mirrored_motion(const Vec2& normal) const override { return reflection_in(normal); }
  bool carries_shear() const override { return false; }
};

/// Nothing moves at it.
class Fixed final : public Support {
 public:
  Mat2 mirrored_motion(const Vec2&) const override { return -Mat2::Identity(); }
  bool carries_shear() const override { return true; }
};

/// The soil continues behind it as it begins at the other side.
class Periodic final : public Support {
 public:
  Mat2 mirrored_motion(const Vec2&) const override { return Mat2::Identity(); }
  bool carries_shear() const override { return false; }
};

}  // namespace

const Support& support_of(BoundaryKind kind) {
  static const Roller roller;
  static const Fixed fixed;
  static const Periodic periodic;
  if (kind == BoundaryKind::fixed) return fixed;
  if (kind == BoundaryKind::periodic) return periodic;
  return roller;
}

Mat2 reflection_in(const Vec2& normal) { return Mat2::Identity() - 2 * normal * normal.transpose(); }

}  // namespace porosph
