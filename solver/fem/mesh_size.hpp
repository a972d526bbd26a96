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

/// Corners of the outline: where free parts meet, or where the way that the outline is held changes. Where
/// stress is unbounded (a toe, the end of a fixed part) the finest edge is h/64, where it only lacks
/// derivatives (a crest) h/8. Williams 1952, J. Appl. Mech. 19, on which corners those are.
MeshSize mesh_size(const Case&, const MeshLines&, double h);

}  // namespace porosph
