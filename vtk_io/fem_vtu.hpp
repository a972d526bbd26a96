// The finite-element reference as ParaView opens it.
#pragma once

#include <filesystem>

#include "solver/reference/fem/solution.hpp"

namespace porosph {

/// Lagrange triangles of order 4 with point arrays Displacement (3, m), EffectiveStress and TotalStress (6:
/// XX YY ZZ XY YZ XZ, Pa), PorePressure (Pa) and SoilId. Triangles of one soil share their points, with the
/// mean of their stresses; soils do not share points, so what jumps between soils jumps in the picture.
/// A file of that name is replaced. Throws WriteError.
void write_fem_vtu(const FemSolution&, const std::filesystem::path& file);

}  // namespace porosph
