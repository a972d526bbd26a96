// The finite-element reference as ParaView opens it.
#pragma once

#include <filesystem>

#include "solver/fem/solution.hpp"

namespace porosph {

/// Lagrange triangles of order 4 with point arrays Displacement (3, m), EffectiveStress and TotalStress (6:
/// XX YY ZZ XY YZ XZ, Pa), PorePressure (Pa) and SoilId. Triangles of one soil share their points, with the
/// mean of their stresses; soils do not share points, so what jumps between soils jumps in the picture.
/// Throws std::runtime_error if the file cannot be written.
void write_fem_vtu(const FemSolution&, const std::filesystem::path&);

}  // namespace porosph
