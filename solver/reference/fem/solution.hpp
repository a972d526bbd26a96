// What the finite-element reference computed, to be asked for anywhere in the soil.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/reference/fem/p4_mesh.hpp"
#include "solver/reference/fem/triangle_locator.hpp"
#include "solver/reference/fem/triangle_water.hpp"

namespace porosph {

struct FemPoint {
  Eigen::Vector2d displacement = Eigen::Vector2d::Zero();      ///< [m]
  Eigen::Vector4d effective_stress = Eigen::Vector4d::Zero();  ///< sigma' XX YY ZZ XY, tension positive [Pa]
  double pore_pressure = 0;                                    ///< p_w, negative in compression [Pa]
  int soil = 0;                                                ///< index into Case::soils

  /// sigma = sigma' + p_w I (eq. 12), XX YY ZZ XY [Pa]
  Eigen::Vector4d total_stress() const {
    return effective_stress + Eigen::Vector4d(pore_pressure, pore_pressure, pore_pressure, 0);
  }
};

class FemSolution {
 public:
  /// `displacement`: one column per node of `nodes` [m].
  FemSolution(const Case&, Mesh mesh, P4Mesh nodes, MeshWater water, Eigen::Matrix2Xd displacement);

  /// At a point of the soil [m]. Between triangles of one soil the mean of theirs; where soils meet, that of
  /// the soil that the case names first. Throws std::runtime_error outside the mesh.
  FemPoint at(const Point&) const;

  /// In one soil, the mean of its triangles there; nothing where the soil is not.
  std::optional<FemPoint> in_soil(int soil, const Point&) const;

  /// Inside one triangle, without regard to its neighbours.
  FemPoint in_triangle(int triangle, const p4::Barycentric&) const;

  const Mesh& mesh() const { return mesh_; }
  const P4Mesh& p4_mesh() const { return nodes_; }
  const Eigen::Matrix2Xd& displacement() const { return displacement_; }  ///< one column per node [m]

  double seconds = 0;   ///< wall time from mesh to displacements [s]
  int unknowns = 0;     ///< of the linear system
  double rounding = 0;  ///< what rounding has spoilt, relative, in the norm of energy [-]

 private:
  std::vector<SoilCase> soils_;
  Mesh mesh_;
  P4Mesh nodes_;
  MeshWater water_;
  Eigen::Matrix2Xd displacement_;
  TriangleLocator locator_;
};

/// The mean of readings of one soil at one place; at least one.
FemPoint mean(const std::vector<FemPoint>&);

}  // namespace porosph
