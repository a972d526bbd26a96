// Triangles that fill the soils of a case: what the finite-element reference is computed on.
#pragma once

#include <array>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

struct Mesh {
  std::vector<Point> vertices;                ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices, counter-clockwise
  std::vector<int> soils;                     ///< per triangle: index into Case::soils
};

/// Structured mesh, edges at most h [m] along the axes, rows and columns fitted to the water and the
/// boundaries' ends. Needs no VTK. Throws std::runtime_error unless the case is one axis-parallel rectangle
/// of one soil, and h > 0.
Mesh mesh_rectangle(const Case&, double h);

/// Throws std::runtime_error if an index is out of range, a triangle is flat or clockwise, an edge belongs to
/// more than two triangles, a vertex belongs to none, or the mesh is empty.
void check_mesh(const Mesh&, int soil_count);

/// Twice the signed area, positive if a, b, c turn counter-clockwise [m2].
double twice_area(const Point& a, const Point& b, const Point& c);

/// Diagonal of the smallest box around the points [m].
double extent(const std::vector<Point>& points);

}  // namespace porosph
