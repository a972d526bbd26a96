// Contact of elastic bodies that were apart at the start.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/model/model.hpp"

namespace porosph {

/// The body that each soil belongs to: soils are of one body where their particles are within `range` [m] of
/// each other at the start. Empty where there is one body only, or where soil flows, which merges with what
/// it meets.
std::vector<std::int32_t> bodies_of_soils(const Model& model, double range);

/// Two particles of different bodies that come nearer than the spacing dx push each other apart along the
/// line between them,
///
///   f = k (dx - r),     k = M / 4 of the softer one,
///
/// without friction and without loss: a quarter of M keeps the frequency below that of the bodies
/// themselves, which sets the time step, and holds an impact at up to a quarter of the wave speed.
void add_contact(const Model& model, std::span<const std::pair<std::int32_t, std::int32_t>> strangers,
                 std::span<Vec2> accelerations);

}  // namespace porosph
