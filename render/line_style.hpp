// How lines and points of a chart stay distinct, also without colour vision.
#pragma once

#include "render/canvas.hpp"

namespace porosph::render {

enum class LineStyle { none, solid, dashed, dotted, dash_dotted };
enum class Marker { none, circle, square, triangle, diamond };

/// Colour of the i-th series: M. Okabe and K. Ito (2008), Color universal design, without its yellow, which
/// is too light for lines. Repeats after seven.
Colour series_colour(std::size_t i);

/// Dash pattern [pixels]; empty for solid lines.
std::vector<double> dash_pattern(LineStyle style);

void draw_marker(Canvas& canvas, Pixel at, Marker marker, const Colour& colour);

}  // namespace porosph::render
