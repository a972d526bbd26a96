#include "render/contour_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace porosph::render {

namespace {

constexpr double widest = 1600, tallest = 1200;  // of a fitted figure [pixels]
constexpr double tallest_panel = 680;            // in a fitted figure [pixels]
constexpr double edge = 14;                      // around the figure [pixels]
constexpr double bar_gap = 16, gap_after_bar = 22;

struct PanelGrid {
  int columns, rows, panels;
  int row(int panel) const { return panel / columns; }
  int column(int panel) const { return panel % columns; }
  bool ends_row(int panel) const { return column(panel) == columns - 1 || panel == panels - 1; }
};

PanelGrid make_grid(int panels, int columns) { return {columns, (panels + columns - 1) / columns, panels}; }

/// A shared bar at the end of a full row also serves a last row that is not full.
bool served_above(const ContourSpace& space, const PanelGrid& grid, int panel) {
  const int row = grid.row(panel);
  if (row == 0 || space.own_scale[panel] || panel != grid.panels - 1 ||
      grid.column(panel) == grid.columns - 1)
    return false;
  return !space.own_scale[row * grid.columns - 1];
}

bool bar_after(const ContourSpace& space, const PanelGrid& grid, int panel) {
  if (served_above(space, grid, panel)) return false;
  return space.own_scale[panel] || grid.ends_row(panel) || space.own_scale[panel + 1];
}

std::vector<double> bar_widths(const ContourSpace& space, const PanelGrid& grid) {
  std::vector<double> widths(grid.columns, 0.);
  for (int panel = 0; panel < grid.panels; ++panel)
    if (bar_after(space, grid, panel))
      widths[grid.column(panel)] =
          bar_gap + space.bar_slot + (grid.column(panel) < grid.columns - 1 ? gap_after_bar : 0);
  return widths;
}

struct Fixed {
  double width, height;  ///< pixels that do not grow with the panels
};

Fixed fixed_parts(const ContourSpace& space, const PanelGrid& grid) {
  Fixed fixed{2 * edge, 2 * edge + space.header};
  for (const double bar : bar_widths(space, grid)) fixed.width += bar;
  fixed.width += grid.columns * (space.margins.left + space.margins.right + 2 * space.padding);
  fixed.height += grid.rows * (space.margins.top + space.margins.bottom + 2 * space.padding);
  return fixed;
}

double scale_within(const ContourSpace& space, const PanelGrid& grid, double width, double height) {
  const Fixed fixed = fixed_parts(space, grid);
  return std::min((width - fixed.width) / (grid.columns * space.world_width),
                  (height - fixed.height) / (grid.rows * space.world_height));
}

/// How large the panels come out; a grid with empty cells has to be worth it.
double merit(const ContourSpace& space, const PanelGrid& grid, double width, double height) {
  const bool full = grid.columns * grid.rows == grid.panels;
  return (full ? 1 : 0.8) * scale_within(space, grid, width, height);
}

PanelGrid best_grid(const ContourSpace& space, const ContourSize& size, double width, double height) {
  const int panels = static_cast<int>(space.own_scale.size());
  if (size.columns > 0) return make_grid(panels, std::min(size.columns, panels));
  PanelGrid best = make_grid(panels, 1);
  for (int columns = 2; columns <= panels; ++columns) {
    const PanelGrid grid = make_grid(panels, columns);
    if (merit(space, grid, width, height) > merit(space, best, width, height)) best = grid;
  }
  return best;
}

/// Frames are wider than the world where their titles need it and there is room.
Pixel frame_size(const ContourSpace& space, const PanelGrid& grid, double scale, double width) {
  const double room = (width - fixed_parts(space, grid).width) / grid.columns + 2 * space.padding;
  return {
      std::floor(std::max(scale * space.world_width + 2 * space.padding, std::min(space.least_frame, room))),
      std::floor(scale * space.world_height + 2 * space.padding)};
}

Box frame_of(const ContourSpace& space, const PanelGrid& grid, int panel, Pixel size, Pixel top_left) {
  const std::vector<double> bars = bar_widths(space, grid);
  double x = top_left.x + space.margins.left;
  for (int column = 0; column < grid.column(panel); ++column)
    x += size.x + space.margins.right + bars[column] + space.margins.left;
  const double cell = size.y + space.margins.top + space.margins.bottom;
  const double y = top_left.y - grid.row(panel) * cell - space.margins.top - size.y;
  return {std::round(x), std::round(y), size.x, size.y};
}

/// A shared bar beside a panel that stands right above another one of the same scale continues into it.
std::vector<BarPlace> place_bars(const ContourSpace& space, const PanelGrid& grid,
                                 const std::vector<Box>& frames) {
  std::vector<BarPlace> bars;
  for (int column = 0; column < grid.columns; ++column) {
    bool continues = false;
    for (int panel = column; panel < grid.panels; panel += grid.columns) {
      const bool here = bar_after(space, grid, panel), shared = here && !space.own_scale[panel];
      const Box& frame = frames[panel];
      if (shared && continues) {
        Box& bar = bars.back().box;
        bar.height = bar.top() - frame.y;
        bar.y = frame.y;
      } else if (here) {
        bars.push_back(
            {{frame.right() + space.margins.right + bar_gap, frame.y, space.bar_slot, frame.height}, panel});
      }
      continues = shared;
    }
  }
  return bars;
}

}  // namespace

ContourLayout lay_out(const ContourSpace& space, const ContourSize& size) {
  const double width = size.width > 0 ? size.width : widest, height = size.height > 0 ? size.height : tallest;
  const PanelGrid grid = best_grid(space, size, width, height);
  const Fixed fixed = fixed_parts(space, grid);
  ContourLayout layout;
  layout.pixels_per_metre = scale_within(space, grid, width, height);
  if (size.height <= 0)
    layout.pixels_per_metre = std::min(layout.pixels_per_metre, tallest_panel / space.world_height);
  if (layout.pixels_per_metre * std::max(space.world_width, space.world_height) < 40)
    throw std::runtime_error(
        fmt::format("render: {} panels do not fit into {:.0f} x {:.0f} pixels; make the picture larger",
                    grid.panels, width, height));

  const Pixel frame = frame_size(space, grid, layout.pixels_per_metre, width);
  const double content_width = fixed.width + grid.columns * (frame.x - 2 * space.padding);
  const double content_height = fixed.height + grid.rows * (frame.y - 2 * space.padding);
  const double fitted_width = std::clamp(content_width, std::min(size.least_width, widest), widest);
  layout.width = size.width > 0 ? size.width : static_cast<int>(std::ceil(fitted_width));
  layout.height = size.height > 0 ? size.height : static_cast<int>(std::ceil(content_height));
  const Pixel top_left{0.5 * (layout.width - content_width) + edge,
                       0.5 * (layout.height + content_height) - edge - space.header};
  for (int panel = 0; panel < grid.panels; ++panel)
    layout.frames.push_back(frame_of(space, grid, panel, frame, top_left));
  layout.bars = place_bars(space, grid, layout.frames);
  return layout;
}

}  // namespace porosph::render
