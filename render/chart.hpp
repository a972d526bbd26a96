// Line charts: histories with their theory, and log-log plots of error against work.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/colour_range.hpp"
#include "render/line_style.hpp"

namespace porosph::render {

/// How a line ends.
enum class LineEnd {
  plain,
  stopped,  ///< a dot: there is no more, and none is missing
  broken,   ///< a cross: what it shows broke down there
};

/// Points in order. Where a value is not finite (or not positive on a logarithmic axis) the line is
/// interrupted.
struct ChartSeries {
  std::string label;  ///< in the legend; empty: not in it
  std::vector<double> x, y;
  std::optional<Colour> colour = {};  ///< default: the next one of series_colour
  LineStyle line = LineStyle::solid;
  Marker marker = Marker::none;
  double width = 2;  ///< [pixels]
  LineEnd end = LineEnd::plain;
};

/// A horizontal line across the chart, such as a theoretical value.
struct ReferenceLine {
  std::string label;
  double y = 0;
  LineStyle line = LineStyle::dashed;
  Colour colour = {90, 90, 90};
};

/// An upright line across the chart, such as the beginning of a stage.
struct UprightLine {
  std::string label;
  double x = 0;
};

struct ChartAxis {
  std::string title;  ///< with its unit, e.g. "t [s]"
  bool logarithmic = false;
  std::optional<ValueRange> range = {};  ///< default: all data and reference lines
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series;  ///< the first is drawn on top
  std::vector<ReferenceLine> references;
  std::vector<UprightLine> uprights = {};  ///< in the order of x
  bool to_scale = false;  ///< a unit is as long along x as along y: one range is made longer than asked for
};

struct ChartFigure {
  std::string title;  ///< may be empty
  std::vector<Chart> charts;
  int columns = 1;
  int width = 0, height = 0;  ///< [pixels]; 0: 760 x 400 per chart
};

/// Draws the charts as PNG, SVG or PDF, by the extension, equal in size, row by row. Same figure, same bytes.
/// May be called from any thread. Throws std::runtime_error for series of unequal x and y, a range that its
/// axis cannot show, a picture too small for its charts, a missing font or a file that cannot be written.
void save_charts(const ChartFigure& figure, const std::filesystem::path& path);

}  // namespace porosph::render
