#include "render/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "render/chart_range.hpp"
#include "render/drawing.hpp"
#include "render/legend.hpp"
#include "render/offscreen_window.hpp"
#include "render/upright_lines.hpp"

namespace porosph::render {

namespace {

constexpr double figure_title_text = 19, chart_title_text = 15;
constexpr double edge = 12, legend_gap = 12;
constexpr int default_width = 760, default_height = 400, least_frame = 60;

void check(const Chart& chart) {
  for (const ChartSeries& series : chart.series)
    if (series.x.size() != series.y.size())
      throw std::runtime_error(fmt::format("render: chart '{}', series '{}': {} x for {} y", chart.title,
                                           series.label, series.x.size(), series.y.size()));
}

Pen pen_of(const ChartSeries& series, std::size_t index) {
  return {.colour = series.colour.value_or(series_colour(index)),
          .width = series.width,
          .dashes = dash_pattern(series.line)};
}

Pen pen_of(const ReferenceLine& reference) {
  return {.colour = reference.colour, .width = 1.4, .dashes = dash_pattern(reference.line)};
}

std::vector<LegendEntry> legend_of(const Chart& chart) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& series = chart.series[i];
    if (!series.label.empty())
      entries.push_back({series.label, pen_of(series, i), series.line != LineStyle::none, series.marker});
  }
  for (const ReferenceLine& reference : chart.references)
    if (!reference.label.empty()) entries.push_back({reference.label, pen_of(reference)});
  return entries;
}

/// Cuts the longest labels short until the legend takes no more than this width [pixels].
void shorten(std::vector<LegendEntry>& entries, double width) {
  const auto is_part_of_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  constexpr std::size_t shortest = 8;  // bytes
  const std::string dots = "…";
  while (legend_extent(entries).x > width) {
    const auto longest = std::ranges::max_element(
        entries, {}, [](const LegendEntry& e) { return text_extent(e.label, 13).x; });
    std::string& label = longest->label;
    if (label.ends_with(dots)) label.resize(label.size() - dots.size());
    if (label.size() <= shortest) return;
    do {
      label.pop_back();
    } while (is_part_of_letter(label.back()));
    if (static_cast<unsigned char>(label.back()) >= 0xC0) label.pop_back();
    label += dots;
  }
}

/// The series as lines on the picture, broken where a point has no place on it.
std::vector<std::vector<Pixel>> lines_of(const ChartSeries& series, const Plot& plot) {
  std::vector<std::vector<Pixel>> lines(1);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (showable(plot.x, series.x[i]) && showable(plot.y, series.y[i]))
      lines.back().push_back(plot.at(series.x[i], series.y[i]));
    else if (!lines.back().empty())
      lines.emplace_back();
  }
  return lines;
}

std::vector<Pixel> line_of(const ReferenceLine& reference, const Plot& plot) {
  if (!showable(plot.y, reference.y)) return {};
  return {plot.at(plot.x.low, reference.y), plot.at(plot.x.high, reference.y)};
}

std::vector<std::vector<Pixel>> all_lines(const Chart& chart, const Plot& plot) {
  std::vector<std::vector<Pixel>> lines;
  for (const ChartSeries& series : chart.series)
    for (auto& line : lines_of(series, plot)) lines.push_back(std::move(line));
  for (const ReferenceLine& reference : chart.references) lines.push_back(line_of(reference, plot));
  for (const Box& name : label_boxes(chart.uprights, plot))
    if (name.width > 0) lines.push_back({{name.x, name.y}, {name.right(), name.y}});
  return lines;
}

struct ChartPlan {
  Plot plot;
  std::vector<LegendEntry> entries;
  Box legend;
  bool legend_is_aside = false;
};

FrameMargins margins_of(const Chart& chart, const Box& cell) {
  FrameMargins margins =
      frame_margins(x_axis_of(chart), y_axis_of(chart), 0.8 * cell.width, 0.7 * cell.height);
  margins.top += chart.title.empty() ? 0 : 1.6 * chart_title_text;
  return margins;
}

/// Makes the shorter axis longer: y at its upper end, x at both.
void make_equal(Plot& plot) {
  const double x = (plot.x.high - plot.x.low) / plot.box.width,
               y = (plot.y.high - plot.y.low) / plot.box.height;
  if (x > y) plot.y.high = plot.y.low + x * plot.box.height;
  const double more = y > x ? (y - x) * plot.box.width / 2 : 0;
  plot.x.low -= more, plot.x.high += more;
}

Plot plot_in(const Chart& chart, const Box& cell, const FrameMargins& margins) {
  Plot plot{{}, x_axis_of(chart), y_axis_of(chart)};
  plot.box = {std::round(cell.x + margins.left), std::round(cell.y + margins.bottom),
              std::round(cell.width - margins.left - margins.right),
              std::round(cell.height - margins.top - margins.bottom)};
  if (plot.box.width < least_frame || plot.box.height < least_frame)
    throw std::runtime_error(
        fmt::format("render: chart '{}' does not fit into {:.0f} x {:.0f} pixels; make the picture "
                    "larger",
                    chart.title, cell.width, cell.height));
  if (chart.to_scale) make_equal(plot);
  return plot;
}

/// The legend goes into a corner without data, or else to the right of the frame, where `aside` is the room
/// for it [pixels]; 0: not decided yet.
ChartPlan plan(const Chart& chart, const Box& cell, FrameMargins margins, double aside) {
  ChartPlan result{plot_in(chart, cell, margins), legend_of(chart), {}};
  shorten(result.entries, 0.5 * cell.width);
  const Pixel extent = legend_extent(result.entries);
  if (aside == 0)
    if (const auto corner = free_corner(result.plot.box, extent, all_lines(chart, result.plot))) {
      result.legend = *corner;
      return result;
    }
  margins.right += std::max(aside, extent.x + legend_gap);
  result.plot = plot_in(chart, cell, margins);
  const Box& frame = result.plot.box;
  result.legend = {frame.right() + margins.right - std::max(aside, extent.x + legend_gap) + legend_gap,
                   frame.top() - extent.y, extent.x, extent.y};
  result.legend_is_aside = true;
  return result;
}

/// The frames of charts above each other start at the same x, and end at the same x: where one has its legend
/// beside it, all have.
std::vector<ChartPlan> plan_all(const ChartFigure& figure, int columns, const std::vector<Box>& cells) {
  const std::size_t count = cells.size();
  std::vector<FrameMargins> margins;
  for (std::size_t i = 0; i < count; ++i) margins.push_back(margins_of(figure.charts[i], cells[i]));
  std::vector<ChartPlan> plans;
  for (std::size_t i = 0; i < count; ++i) {
    FrameMargins aligned = margins[i];
    for (std::size_t k = i % columns; k < count; k += columns)
      aligned.left = std::max(aligned.left, margins[k].left);
    margins[i] = aligned;
    plans.push_back(plan(figure.charts[i], cells[i], aligned, 0));
  }
  for (int column = 0; column < columns; ++column) {
    double aside = 0;
    bool any = false;
    for (std::size_t i = column; i < count; i += columns) {
      any = any || plans[i].legend_is_aside;
      aside = std::max(aside, legend_extent(plans[i].entries).x + legend_gap);
    }
    for (std::size_t i = column; any && i < count; i += columns)
      plans[i] = plan(figure.charts[i], cells[i], margins[i], aside);
  }
  return plans;
}

void draw_series(Canvas& canvas, const ChartSeries& series, const Pen& pen, const Plot& plot) {
  for (const auto& line : lines_of(series, plot)) {
    if (series.line != LineStyle::none) canvas.line(line, pen);
    for (const Pixel& point : line) draw_marker(canvas, point, series.marker, pen.colour);
  }
}

/// After the clipping, so that marks on the frame are whole.
void draw_end(Canvas& canvas, const ChartSeries& series, const Pen& pen, const Plot& plot) {
  constexpr double reach = 6;
  const auto lines = lines_of(series, plot);
  if (series.end == LineEnd::plain || lines.back().empty()) return;
  const Pixel at = lines.back().back();
  if (at.x < plot.box.x || at.x > plot.box.right() || at.y < plot.box.y || at.y > plot.box.top()) return;
  if (series.end == LineEnd::stopped) return draw_marker(canvas, at, Marker::circle, pen.colour);
  for (const Pen& stroke : {Pen{.colour = white, .width = 5}, Pen{.colour = pen.colour, .width = 2.5}}) {
    canvas.line({at.x - reach, at.y - reach}, {at.x + reach, at.y + reach}, stroke);
    canvas.line({at.x - reach, at.y + reach}, {at.x + reach, at.y - reach}, stroke);
  }
}

void draw_chart(Canvas& canvas, const Chart& chart, const ChartPlan& plan) {
  const Box& frame = plan.plot.box;
  draw_grid(canvas, plan.plot);
  canvas.clip(frame);
  draw_uprights(canvas, chart.uprights, plan.plot);
  for (const ReferenceLine& reference : chart.references)
    canvas.line(line_of(reference, plan.plot), pen_of(reference));
  for (std::size_t i = chart.series.size(); i-- > 0;)
    draw_series(canvas, chart.series[i], pen_of(chart.series[i], i), plan.plot);
  canvas.unclip();
  draw_frame(canvas, plan.plot);
  for (std::size_t i = chart.series.size(); i-- > 0;)
    draw_end(canvas, chart.series[i], pen_of(chart.series[i], i), plan.plot);
  canvas.text({frame.x, frame.top() + 8}, chart.title,
              {.size = fitting_size(chart.title, chart_title_text, frame.width),
               .horizontal = Align::low,
               .vertical = Align::low});
  if (!plan.entries.empty()) draw_legend(canvas, plan.legend, plan.entries);
}

/// Equal cells, row by row from the top.
std::vector<Box> cells_of(int count, int columns, double width, double height) {
  const int rows = (count + columns - 1) / columns;
  const double cell_width = width / columns, cell_height = height / rows;
  std::vector<Box> cells;
  for (int i = 0; i < count; ++i) {
    const int row = i / columns, column = i % columns;
    cells.push_back({column * cell_width + edge, height - (row + 1) * cell_height + edge,
                     cell_width - 2 * edge, cell_height - 2 * edge});
  }
  return cells;
}

}  // namespace

void save_charts(const ChartFigure& figure, const std::filesystem::path& path) {
  if (figure.charts.empty()) throw std::runtime_error("render: a chart figure without charts");
  for (const Chart& chart : figure.charts) check(chart);
  const int count = static_cast<int>(figure.charts.size()), columns = std::clamp(figure.columns, 1, count);
  const int rows = (count + columns - 1) / columns;
  const int header = figure.title.empty() ? 0 : 36;
  const int width = figure.width > 0 ? figure.width : columns * default_width;
  const int height = figure.height > 0 ? figure.height : rows * default_height + header;

  std::vector<ChartPlan> plans;
  {
    const std::scoped_lock lock(render_mutex());  // texts are measured
    plans = plan_all(figure, columns, cells_of(count, columns, width, height - header));
  }
  save_drawing({.width = width,
                .height = height,
                .title = figure.title,
                .layers = {},
                .paint =
                    [&](Canvas& canvas) {
                      for (int i = 0; i < count; ++i) draw_chart(canvas, figure.charts[i], plans[i]);
                      canvas.text({0.5 * width, height - 12.}, figure.title,
                                  {.size = fitting_size(figure.title, figure_title_text, width - 20),
                                   .vertical = Align::high});
                    }},
               path);
}

}  // namespace porosph::render
