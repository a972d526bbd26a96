// Drains and wells in the soil: particles whose head is given.
#pragma once

#include <vector>

#include "solver/case/case.hpp"
#include "solver/water/flow/outline.hpp"
#include "solver/water/flow/pair_flux.hpp"

namespace porosph {

/// Adds a face for each drain, and a patch for each particle within half a spacing of its line (at a point,
/// the nearest one), which then has the drain's head as one on the outline has its face's. A drain without a
/// level is a seepage face.
///
/// A particle at a point draws like a well of the radius r = 0.163 spacings. With one of its own, r_w < r,
/// it keeps a head h that follows from what enters from the well's,
///
///   q = 2 pi k (h_w - h) / ln(r / r_w)
///
/// (Peaceman 1978, whose r is that of a grid of five points). Throws std::runtime_error where no particle is
/// near.
void add_drains(const Case& scene, const Particles& particles, const Vec2& origin,
                std::vector<HydraulicFaceCase>& faces, HydraulicOutline& outline, FlowPairs& pairs);

}  // namespace porosph
