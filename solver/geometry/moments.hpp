// Area and first moments of what closed rings enclose.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

struct Moments {
  double area = 0;              ///< counter-clockwise rings count positive [m2]
  Point first = Point::Zero();  ///< integral of position - origin over the area [m3]
};

/// Green's theorem over all rings (the shoelace formula). An origin near the rings keeps round-off small.
Moments moments(const std::vector<Polygon>& rings, const Point& origin);

}  // namespace porosph
