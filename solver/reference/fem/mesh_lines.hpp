// The lines that a mesh of a case must follow: outlines, interfaces between soils, water levels and stretch
// ends.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

struct MeshLine {
  int from, to;     ///< indices into MeshLines::points
  int left, right;  ///< soil on each side, index into Case::soils; -1 outside all soils
  bool outline() const { return left < 0 || right < 0; }
};

/// Straight lines that meet only in their ends.
struct MeshLines {
  std::vector<Point> points;  ///< [m]
  std::vector<MeshLine> lines;
};

/// Throws std::runtime_error if two soils overlap or there is no soil.
MeshLines mesh_lines(const Case&);

/// The soil that a point lies in, -1 in none. Throws std::runtime_error if it lies in more than one.
int soil_at(const Case&, const Point&);

}  // namespace porosph
