// A framed plot with ticks and titles: where values fall on the picture.
#pragma once

#include <string>
#include <vector>

#include "render/canvas.hpp"

namespace porosph::render {

struct Axis {
  double low = 0, high = 1;  ///< low < high; both > 0 if logarithmic
  bool logarithmic = false;
  std::string title;                    ///< with its unit, e.g. "x [m]"
  double fraction(double value) const;  ///< 0 at low, 1 at high, linear beyond
};

struct AxisTicks {
  std::vector<double> major, minor;
  std::vector<std::string> labels;  ///< one per major tick
  std::string factor;               ///< common factor of the labels, or empty
  double unit = 1;                  ///< that factor
};

inline constexpr double tick_text = 13, title_text = 14;  ///< text sizes [pixels]

/// As many ticks as fit on `length` pixels without their labels coming close to each other.
AxisTicks fitting_ticks(const Axis& axis, double length, bool upright);

struct Plot {
  Box box;  ///< the frame, without labels
  Axis x, y;
  Pixel at(double x_value, double y_value) const;
};

/// Space that tick labels and titles take beyond the frame, for a plot of about this size [pixels].
struct FrameMargins {
  double left = 0, bottom = 0, right = 0, top = 0;
};
FrameMargins frame_margins(const Axis& x, const Axis& y, double width, double height);

void draw_grid(Canvas& canvas, const Plot& plot);
void draw_frame(Canvas& canvas, const Plot& plot);

}  // namespace porosph::render
