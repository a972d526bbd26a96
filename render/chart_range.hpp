// What the axes of a chart span.
#pragma once

#include "render/axes.hpp"
#include "render/chart.hpp"

namespace porosph::render {

/// Axes that hold all data and reference lines that they can show, with a little air, or the ranges that were
/// given. Without any such data: 0 to 1, or 1 to 10 if logarithmic. Throws std::runtime_error for a given
/// range that is empty, not finite, or not positive on a logarithmic axis.
Axis x_axis_of(const Chart& chart);
Axis y_axis_of(const Chart& chart);

/// Whether the axis has a place for the value.
bool showable(const Axis& axis, double value);

}  // namespace porosph::render
