#include "solver/geometry/moments.hpp"

namespace porosph {

Moments moments(const std::vector<Polygon>& rings, const Point& origin) {
  Moments sum;
  for (const Polygon& ring : rings) {
    if (ring.empty()) continue;
    Point a = ring.back() - origin;
    for (const Point& vertex : ring) {
      const Point b = vertex - origin;
      const double cross = a.x() * b.y() - a.y() * b.x();
      sum.area += cross / 2;
      sum.first += cross / 6 * (a + b);
      a = b;
    }
  }
  return sum;
}

}  // namespace porosph
