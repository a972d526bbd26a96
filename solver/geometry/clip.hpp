// Cutting rings with straight lines.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// The points p with normal . p <= offset; normal of any length but zero.
struct HalfPlane {
  Point normal = Point::Zero();
  double offset = 0;
};

/// Takes away what lies outside of the half-plane (Sutherland and Hodgman 1974). Where a ring falls into
/// pieces these stay joined by edges along the line that run back and forth: they add nothing to integrals
/// over the region, which are exact for rings of any shape, non-convex or with holes. Rings of which nothing
/// is left are removed.
void clip(std::vector<Polygon>& rings, const HalfPlane& half_plane);

/// Length along which the rings border on the half-plane's line, edges that run back and forth cancelled [m].
/// half_plane: with a unit normal. tolerance: distance up to which a point is on the line [m].
double length_on_line(const std::vector<Polygon>& rings, const HalfPlane& half_plane, double tolerance);

/// The stretch along the half-plane's line, to the left of its normal, from the first to the last point that
/// the rings have there [m]; no stretch (from > to) if they have none.
struct Stretch {
  double from, to;
};
Stretch stretch_on_line(const std::vector<Polygon>& rings, const HalfPlane& half_plane, double tolerance);

}  // namespace porosph
