// What theory says of the soil at some points, as a frame of their values.
#pragma once

#include <optional>
#include <vector>

#include "solver/case/case.hpp"
#include "solver/output/frame.hpp"

namespace porosph {

/// The state of rest that the case's reference describes, of soil that is at `starts` at t = 0 [m]: fields
/// EffectiveStress, Displacement and PorePressure, at the places where that soil comes to rest. Empty for a
/// case without a reference.
std::optional<Frame> exact_state(const Case& scene, const std::vector<Point>& starts);

}  // namespace porosph
