// Which triangles of a mesh a point lies in.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "solver/reference/fem/mesh.hpp"
#include "solver/reference/fem/p4_triangle.hpp"

namespace porosph {

/// Square bins over the mesh, each with the triangles whose boxes touch it.
class TriangleLocator {
 public:
  explicit TriangleLocator(const Mesh&);

  struct Hit {
    int triangle;
    p4::Barycentric at;
  };
  /// Every triangle that the point is in or on the edge of (within 1e-8 of its size); empty outside the mesh.
  /// `mesh` is the one that the bins were made from.
  std::vector<Hit> find(const Mesh& mesh, const Point&) const;

 private:
  Eigen::Array2i bin_of(const Point&) const;

  Eigen::AlignedBox2d box_;
  double width_ = 1;  ///< of a bin [m]
  Eigen::Array2i bins_ = Eigen::Array2i::Ones();
  std::vector<std::vector<int>> triangles_;
};

}  // namespace porosph
