// What every kind of support of the soil offers.
#pragma once

#include "solver/case/case.hpp"
#include "solver/space/tensor.hpp"

namespace porosph {

/// How a wall holds the soil in front of it.
class Support {
 public:
  virtual ~Support() = default;

  /// How the motion of the soil appears behind a wall with this unit normal: the matrix that mirrors it.
  virtual Mat2 mirrored_motion(const Vec2& normal) const = 0;

  /// The soil cannot slide along it, so it may carry shear stress. Drawings show it as hatching, where this
  /// is false as rollers; finite elements hold their nodes accordingly.
  virtual bool carries_shear() const = 0;
};

/// The support of a kind of boundary; it lives as long as the program.
const Support& support_of(BoundaryKind kind);

/// R = I - 2 n n^T.
Mat2 reflection_in(const Vec2& normal);

}  // namespace porosph
