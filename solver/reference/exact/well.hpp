// Steady flow to a well whose sides hold a level, in the plane.
#pragma once

#include "solver/space/tensor.hpp"

namespace porosph {

/// A line sink in the rectangle from (0, 0) to `size` whose sides have one head H. Where it draws q per
/// metre,
///
///   H - h = q / (2 pi k) drop(at),   drop -> ln(R / r) towards the well (Thiem),
///
/// so a well of radius r << R with the head h_w draws q = 2 pi k (H - h_w) / ln(R / r).
class WellInRectangle {
 public:
  WellInRectangle(const Vec2& size, const Vec2& well);

  double drop(const Vec2& at) const;
  double reach() const;  ///< R [m]

 private:
  template <class OfWell>
  double with_images(const Vec2& at, OfWell&& of_well) const;

  Vec2 size_, well_;
};

}  // namespace porosph
