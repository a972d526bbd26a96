// The pore water in each triangle of a mesh.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/reference/fem/mesh.hpp"

namespace porosph {

/// Hydrostatic pore pressure inside one triangle, which is either all below the water level or all above it.
struct TriangleWater {
  bool saturated = false;
  double level = 0;        ///< y of the free surface [m]
  double unit_weight = 0;  ///< gamma_w [N/m3]
  double pore_pressure(double y) const { return saturated ? -unit_weight * (level - y) : 0; }  ///< p_w [Pa]
};

/// The pore water of a mesh: at rest in each triangle, or known at the P4 mesh's nodes where it flows.
struct MeshWater {
  std::vector<TriangleWater> triangles;
  std::vector<double> pore_pressure;  ///< p_w at the nodes [Pa]; empty where the water stands
  std::vector<double> pressure_head;  ///< psi at the nodes [m]
  bool flows() const { return !pore_pressure.empty(); }
};

/// Water beside one edge of the outline, where a stretch ends at it and the triangle is not under it: its
/// pressure acts on the face, up to its level.
struct WaterBeside {
  const WaterStretch* stretch = nullptr;  ///< nullptr: the triangle's own water, or none, is beside it
  double unit_weight = 0;                 ///< gamma_w [N/m3]
  double pore_pressure(double y) const { return -unit_weight * std::max(0.0, stretch->level - y); }  ///< [Pa]
};

/// Of the edge from `from` to `to`, the soil on its left and the inside of the triangle around `middle`.
/// beside: distance up to which a stretch that ends short of the edge still touches it [m].
WaterBeside water_beside(const WaterCase&, const Point& from, const Point& to, const Point& middle,
                         double beside);

/// One per triangle. Throws std::runtime_error where a water level or the end of a stretch cuts through a
/// triangle.
std::vector<TriangleWater> water_of_triangles(const WaterCase&, const Mesh&);

}  // namespace porosph
