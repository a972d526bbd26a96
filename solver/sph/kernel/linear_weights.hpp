// Interpolation between particles that is exact for linear fields.
#pragma once

#include <vector>

#include "solver/space/tensor.hpp"

namespace porosph {

/// Weights of the particles `near` that reproduce linear fields at `here`; the plain kernel mean where they
/// do not span the plane.
std::vector<double> linear_weights(const Vec2& here, const std::vector<Vec2>& near,
                                   const std::vector<double>& volumes, double smoothing_length);

}  // namespace porosph
