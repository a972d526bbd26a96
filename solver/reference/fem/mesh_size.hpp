// How large the triangles of a mesh are from place to place: finer towards the corners where stress is
// singular.
#pragma once

#include <vector>

#include "solver/reference/fem/mesh_lines.hpp"

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

/// At the outline's rough_points() the finest edge is h/64 where stress is unbounded, h/8 where it only lacks
/// derivatives. Ends of lines shorter than h count with their length.
MeshSize mesh_size(const Case&, const MeshLines&, double h);

}  // namespace porosph
