// How large the triangles of a mesh are from place to place: finer towards the corners where stress is
// singular.
#pragma once

#include <vector>

#include "solver/fem/mesh_lines.hpp"

namespace porosph {

struct MeshSize {
  struct Corner {
    Point at;
    double finest;  ///< edge length there [m]
  };
  double h;  ///< edge length far from corners [m]
  std::vector<Corner> corners;

  /// Edge length wanted at p [m]: half the distance to a corner, at least the corner's finest, at most h.
  double operator()(const Point& p) const;
};

/// Corners of the outline: where free parts meet, where the way that the outline is held changes, and where a
/// soil interface or a water level ends on it other than at a roller (where it is taken to be level and so
/// regular). Where stress is unbounded (a toe, the end of a fixed part or of an interface) the finest edge is
/// h/64, where it only lacks derivatives (a crest, a water level) h/8: Williams 1952, J. Appl. Mech. 19. Ends
/// of lines shorter than h count with their length.
MeshSize mesh_size(const Case&, const MeshLines&, double h);

}  // namespace porosph
