// The legend of a chart, and where it hides no data.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/line_style.hpp"

namespace porosph::render {

struct LegendEntry {
  std::string label;
  Pen pen;
  bool line = true;
  Marker marker = Marker::none;
};

/// Width and height of the legend [pixels]; zero without entries.
Pixel legend_extent(const std::vector<LegendEntry>& entries);

/// The corner of `frame` where a legend of this extent covers none of the lines; none if it would everywhere.
std::optional<Box> free_corner(const Box& frame, Pixel extent, std::span<const std::vector<Pixel>> lines);

void draw_legend(Canvas& canvas, const Box& box, const std::vector<LegendEntry>& entries);

}  // namespace porosph::render
