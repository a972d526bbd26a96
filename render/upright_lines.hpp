// Upright lines across a chart, with names at their upper ends: where the stages of a run begin.
#pragma once

#include <vector>

#include "render/axes.hpp"
#include "render/chart.hpp"

namespace porosph::render {

/// Where the names stand, right of their lines; without width where there is no room for one. [pixels]
std::vector<Box> label_boxes(const std::vector<UprightLine>& uprights, const Plot& plot);

/// Lines that the x axis does not show are left out.
void draw_uprights(Canvas& canvas, const std::vector<UprightLine>& uprights, const Plot& plot);

}  // namespace porosph::render
