// Stress of elastic soil by the neighbours that a stage leaves it.
#pragma once

#include <cstdint>
#include <span>

#include "solver/run/hand_over.hpp"

namespace porosph {

/// Whether strain can be told from displacement: no soil has been placed, and none has slid along a sheet.
bool displacement_is_strain(const Case& before, const Case& now);

/// Gives elastic soil the stress that its displacement since the start has by the neighbours of `now`, in
/// place of that by those of `before`, both as drawn: then the final state does not remember the
/// discretisation of soil that was dug out. same[i]: the particle of `before` that particle i of `now` was.
void recompute_stress(const HandedOver& from, const Model& before, const Model& now,
                      std::span<const std::int32_t> same, Particles& particles);

}  // namespace porosph
