#include "render/run/section_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/run/history_lines.hpp"
#include "render/run/shown_field.hpp"
#include "solver/analysis/exact_state.hpp"
#include "solver/space/place_text.hpp"
#include "vtk_io/run_folder/csv.hpp"

namespace porosph::render {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

struct Extent {
  Point low = Point::Constant(never), high = Point::Constant(-never);
};

Extent extent_of(const Frame& frame) {
  Extent e;
  for (std::size_t i = 0; i < frame.points.size(); i += 3) {
    const Point p(frame.points[i], frame.points[i + 1]);
    if (!p.allFinite()) continue;
    e.low = e.low.cwiseMin(p);
    e.high = e.high.cwiseMax(p);
  }
  return e;
}

/// The points to cut along; straight lines reach a little beyond the soil.
std::vector<Point> points_of(const SectionLine& line, const Extent& e, double margin) {
  if (line.kind == SectionLine::vertical)
    return {{line.at, e.low.y() - margin}, {line.at, e.high.y() + margin}};
  if (line.kind == SectionLine::level) return {{e.low.x() - margin, line.at}, {e.high.x() + margin, line.at}};
  return line.points;
}

double length_of(const std::vector<Point>& points) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

double spacing_of(const FinishedRun& run, const Frame& frame) {
  if (run.scene) return run.scene->particles.spacing;
  return std::sqrt(volumes_of(frame).front());
}

/// Two points per spacing, but enough for a smooth line and no more than can be told apart.
int usual_points(double length, double spacing) {
  constexpr double least = 200, most = 2000;
  return static_cast<int>(std::clamp(2 * length / spacing, least, most));
}

/// The pieces of a section in another state of the same soil.
RunSection in_state(const RunSection& section, std::string label, std::vector<Frame> states) {
  RunSection other{.label = std::move(label), .time = gap, .origin = section.origin, .pieces = {}};
  for (std::size_t k = 0; k < states.size(); ++k) {
    SectionPiece piece = section.pieces[k];
    piece.values = std::move(states[k]);
    for (std::size_t i = 0; i < piece.along.size(); ++i) {
      const Point now(section.pieces[k].values.points[3 * i], section.pieces[k].values.points[3 * i + 1]),
          then(piece.values.points[3 * i], piece.values.points[3 * i + 1]);
      piece.along[i] += (then - now).dot(piece.tangent[i]);
    }
    other.pieces.push_back(std::move(piece));
  }
  return other;
}

bool shows(const RunSection& section, const FieldSelection& field) {
  return !section.pieces.empty() && can_show(section.pieces.front().values, field.name);
}

/// Distances, or heights or widths, and values; the pieces apart from each other.
ChartSeries line_of(const RunSection& section, const FieldSelection& field, double factor, bool upright) {
  ChartSeries series{.label = section.label, .x = {}, .y = {}};
  auto &place = upright ? series.y : series.x, &shown = upright ? series.x : series.y;
  for (const SectionPiece& piece : section.pieces) {
    if (!place.empty()) place.push_back(gap), shown.push_back(gap);
    const std::vector<double> values = values_of(piece.values, field);
    for (std::size_t i = 0; i < values.size(); ++i) {
      place.push_back(section.origin + piece.along[i]);
      shown.push_back(values[i] * factor);
    }
  }
  return series;
}

/// Colours of their own, or many in the order of a map, of which some are named.
void style_all(std::vector<ChartSeries>& lines) {
  constexpr std::size_t few = 7;
  if (lines.size() <= few) {
    for (std::size_t i = 0; i < lines.size(); ++i) style(lines[i], i);
    return;
  }
  const auto count = static_cast<int>(lines.size());
  const std::vector<Colour> colours = colour_table(ColourMap::viridis, count);
  const std::size_t step = (lines.size() - 1 + few - 2) / (few - 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].colour = colours[lines.size() - 1 - i];
    lines[i].width = 1.4;
    if (i % step != 0 && i + 1 != lines.size()) lines[i].label.clear();
  }
}

/// A chart has air above and below its lines only.
ValueRange range_of(const std::vector<ChartSeries>& lines) {
  std::vector<double> values;
  for (const ChartSeries& line : lines) values.insert(values.end(), line.x.begin(), line.x.end());
  return rounded_range(finite_extent(values));
}

std::string axis_title(const SectionLine& line) {
  switch (line.kind) {
    case SectionLine::vertical:
      return "y [m]";
    case SectionLine::level:
      return "x [m]";
    case SectionLine::polyline:
      break;
  }
  return "distance [m]";
}

std::string csv_text(double value) {
  std::string text;
  if (!std::isnan(value)) append_csv_number(text, value);
  return text;
}

}  // namespace

std::string SectionLine::text() const {
  if (kind == vertical) return fmt::format("x = {:g} m", at);
  if (kind == level) return fmt::format("y = {:g} m", at);
  std::string text;
  for (const Point& p : points) text += (text.empty() ? "" : " to ") + place_text(p);
  return text + " m";
}

RunSection section_of(const FinishedRun& run, const std::string& label, const Frame& frame,
                      const SectionLine& line, int points, const std::vector<FieldSelection>& fields) {
  const double spacing = spacing_of(run, frame);
  const Extent extent = extent_of(frame);
  const std::vector<Point> way = points_of(line, extent, spacing);
  if (points == 0) points = usual_points(length_of(way), spacing);
  RunSection section{.label = label, .time = frame.time, .origin = 0, .pieces = {}};
  if (line.kind == SectionLine::vertical) section.origin = way.front().y();
  if (line.kind == SectionLine::level) section.origin = way.front().x();
  section.pieces = cut(frame, run.scene ? &*run.scene : nullptr, way, points, fields);
  if (section.pieces.empty())
    throw NoSoil(fmt::format("the section {} does not meet the soil of {}, which lies between {} and {} m",
                             line.text(), run.folder.string(), place_text(extent.low),
                             place_text(extent.high)));
  return section;
}

std::optional<RunSection> exact_section(const Case& scene, const RunSection& section) {
  if (scene.reference == Reference::none) return std::nullopt;
  std::vector<Frame> states;
  for (const SectionPiece& piece : section.pieces) states.push_back(*exact_state(scene, piece.starts));
  const bool conventional = scene.reference == Reference::conventional_column;
  return in_state(section, conventional ? "theory of the conventional form, at rest" : "theory, at rest",
                  std::move(states));
}

RunSection fem_section(const FemReference& fem, const RunSection& section) {
  std::vector<Frame> states;
  for (const SectionPiece& piece : section.pieces) states.push_back(fem.state(piece.starts));
  return in_state(section, "finite elements, at rest", std::move(states));
}

Chart section_chart(const SectionLine& line, const std::vector<RunSection>& sections,
                    const std::vector<RunSection>& references, const FieldSelection& field) {
  const bool upright = line.kind == SectionLine::vertical;
  double largest = 0;
  for (const RunSection& section : sections)
    for (const SectionPiece& piece : section.pieces)
      largest = std::max(largest, largest_of(values_of(piece.values, field)));
  const ShownUnit unit = shown_unit(field.name, largest);
  Chart chart{.title = shown_name(field), .x = {}, .y = {}, .series = {}, .references = {}};
  (upright ? chart.y : chart.x).title = axis_title(line);
  (upright ? chart.x : chart.y).title = shown_label(field, unit);
  for (const RunSection& section : sections)
    chart.series.push_back(line_of(section, field, unit.factor, upright));
  style_all(chart.series);
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (!shows(references[i], field)) continue;
    ChartSeries series = line_of(references[i], field, unit.factor, upright);
    series.colour = i == 0 ? Colour{175, 175, 175} : Colour{110, 110, 110};
    series.line = i == 0 ? LineStyle::solid : LineStyle::dotted;
    series.width = 5;
    chart.series.push_back(std::move(series));
  }
  if (upright) chart.x.range = range_of(chart.series);
  return chart;
}

ChartFigure section_figure(const SectionLine& line, std::vector<Chart> charts, const std::string& title) {
  const bool upright = line.kind == SectionLine::vertical;
  constexpr int most_columns = 3;
  ChartFigure figure{.title = title, .charts = std::move(charts)};
  const int count = static_cast<int>(figure.charts.size());
  figure.columns = upright ? std::min(count, most_columns) : 1;
  const int rows = (count + figure.columns - 1) / figure.columns;
  figure.width = figure.columns * (upright ? (count == 1 ? 640 : 480) : 860);
  figure.height = 36 + rows * (upright ? 560 : 380);
  return figure;
}

std::string section_csv(const std::vector<RunSection>& sections, const std::vector<FieldSelection>& fields) {
  std::vector<std::string> head = {"run", "time", "distance", "x", "y", "x_start", "y_start", "soil"};
  for (const FieldSelection& f : fields) head.push_back(f.text());
  std::string csv = csv_line(head);
  for (const RunSection& section : sections)
    for (const SectionPiece& piece : section.pieces) {
      std::vector<std::vector<double>> columns;
      for (const FieldSelection& f : fields)
        columns.push_back(shows(section, f) ? values_of(piece.values, f)
                                            : std::vector<double>(piece.along.size(), gap));
      for (std::size_t i = 0; i < piece.along.size(); ++i) {
        std::vector<std::string> cells = {section.label, csv_text(section.time)};
        for (const double v : {piece.along[i], piece.values.points[3 * i], piece.values.points[3 * i + 1],
                               piece.starts[i].x(), piece.starts[i].y()})
          cells.push_back(csv_text(v));
        cells.push_back(piece.soil < 0 ? "" : std::to_string(piece.soil));
        for (const auto& column : columns) cells.push_back(csv_text(column[i]));
        csv += csv_line(cells);
      }
    }
  return csv;
}

}  // namespace porosph::render
