// The still water in each triangle of a mesh.
#pragma once

#include <vector>

#include "solver/fem/mesh.hpp"

namespace porosph {

/// Hydrostatic pore pressure inside one triangle, which is either all below the water level or all above it.
struct TriangleWater {
  bool saturated = false;
  double level = 0;        ///< y of the free surface [m]
  double unit_weight = 0;  ///< gamma_w [N/m3]
  double pore_pressure(double y) const { return saturated ? -unit_weight * (level - y) : 0; }  ///< p_w [Pa]
};

/// One per triangle. Throws std::runtime_error where a water level or the end of a stretch cuts through a
/// triangle.
std::vector<TriangleWater> water_of_triangles(const WaterCase&, const Mesh&);

}  // namespace porosph
