// Delaunay's triangulation of points in the plane.
#pragma once

#include <array>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph::render {

/// Triangles of the convex hull, corners counter-clockwise; any of the possible ones where more than three
/// points lie on a circle. Of points that coincide (closer than 1e-8 of the whole) one is used. Throws
/// std::runtime_error for points that are not finite.
std::vector<std::array<int, 3>> delaunay(const std::vector<Point>& points);

}  // namespace porosph::render
