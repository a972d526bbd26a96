// Drains and wells in the soil: particles whose head is given.
#pragma once

#include <vector>

#include "solver/case/flow_case.hpp"
#include "solver/water/flow/outline.hpp"
#include "solver/water/flow/pair_flux.hpp"

namespace porosph {

/// Adds a face for each drain, and a patch for each particle within half a spacing of its line (at a point,
/// the nearest one: a well of 0.163 spacings' radius), which then has the drain's head as one on the outline
/// has its face's. A drain without a level is a seepage face. Throws std::runtime_error where no particle is
/// near.
void add_drains(const std::vector<DrainCase>& drains, const Particles& particles, const Vec2& origin,
                double spacing, std::vector<HydraulicFaceCase>& faces, HydraulicOutline& outline,
                FlowPairs& pairs);

}  // namespace porosph
