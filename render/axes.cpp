#include "render/axes.hpp"

#include <algorithm>
#include <cmath>

#include "render/nice_ticks.hpp"

namespace porosph::render {

namespace {

constexpr double tick_length = 5, label_gap = 5, title_gap = 6;
const Pen frame_pen{.colour = {60, 60, 60}};

AxisTicks make_ticks(const Axis& axis, int max_count) {
  AxisTicks ticks;
  if (axis.logarithmic) {
    LogTicks log = log_ticks(axis.low, axis.high, max_count);
    ticks.labels = log_tick_labels(log.major);
    ticks.major = std::move(log.major);
    ticks.minor = std::move(log.minor);
  } else {
    ticks.major = linear_ticks(axis.low, axis.high, max_count);
    TickLabels text = linear_tick_labels(ticks.major);
    ticks.labels = std::move(text.labels);
    ticks.factor = std::move(text.factor), ticks.unit = text.unit;
  }
  return ticks;
}

bool crowded(const Axis& axis, const AxisTicks& ticks, double length, bool upright) {
  const double gap = upright ? 12 : 16;
  for (std::size_t i = 0; i + 1 < ticks.major.size(); ++i) {
    const double distance = length * (axis.fraction(ticks.major[i + 1]) - axis.fraction(ticks.major[i]));
    const Pixel here = text_extent(ticks.labels[i], tick_text),
                next = text_extent(ticks.labels[i + 1], tick_text);
    const double need = upright ? 0.5 * (here.y + next.y) : 0.5 * (here.x + next.x);
    if (distance < need + gap) return true;
  }
  return false;
}

double widest(const std::vector<std::string>& labels) {
  double width = 0;
  for (const std::string& label : labels) width = std::max(width, text_extent(label, tick_text).x);
  return width;
}

std::string full_title(const Axis& axis, const AxisTicks& ticks) {
  return ticks.factor.empty() ? axis.title : axis.title + "  " + ticks.factor;
}

void draw_x_axis(Canvas& canvas, const Plot& plot, const AxisTicks& ticks) {
  const Box& box = plot.box;
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    const double x = box.x + box.width * plot.x.fraction(ticks.major[i]);
    canvas.line({x, box.y}, {x, box.y - tick_length}, frame_pen);
    canvas.text({x, box.y - tick_length - label_gap}, ticks.labels[i],
                {.size = tick_text, .vertical = Align::high});
  }
  for (const double tick : ticks.minor) {
    const double x = box.x + box.width * plot.x.fraction(tick);
    canvas.line({x, box.y}, {x, box.y - 0.5 * tick_length}, frame_pen);
  }
  const std::string title = full_title(plot.x, ticks);
  canvas.text({box.centre().x, box.y - tick_length - label_gap - tick_text - title_gap}, title,
              {.size = fitting_size(title, title_text, box.width), .vertical = Align::high});
}

void draw_y_axis(Canvas& canvas, const Plot& plot, const AxisTicks& ticks) {
  const Box& box = plot.box;
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    const double y = box.y + box.height * plot.y.fraction(ticks.major[i]);
    canvas.line({box.x, y}, {box.x - tick_length, y}, frame_pen);
    canvas.text({box.x - tick_length - label_gap, y}, ticks.labels[i],
                {.size = tick_text, .horizontal = Align::high});
  }
  for (const double tick : ticks.minor) {
    const double y = box.y + box.height * plot.y.fraction(tick);
    canvas.line({box.x, y}, {box.x - 0.5 * tick_length, y}, frame_pen);
  }
  const std::string title = full_title(plot.y, ticks);
  canvas.text({box.x - tick_length - label_gap - widest(ticks.labels) - title_gap, box.centre().y}, title,
              {.size = fitting_size(title, title_text, box.height),
               .horizontal = Align::centre,
               .vertical = Align::low,
               .upright = true});
}

}  // namespace

double Axis::fraction(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

Pixel Plot::at(double x_value, double y_value) const {
  return {box.x + box.width * x.fraction(x_value), box.y + box.height * y.fraction(y_value)};
}

AxisTicks fitting_ticks(const Axis& axis, double length, bool upright) {
  int count = std::max(2, static_cast<int>(length / (upright ? 27 : 60)));
  AxisTicks ticks = make_ticks(axis, std::min(count, 12));
  for (count = std::min(count, 12) - 1; count >= 1 && crowded(axis, ticks, length, upright); --count)
    ticks = make_ticks(axis, count);
  return ticks;
}

FrameMargins frame_margins(const Axis& x, const Axis& y, double width, double height) {
  const AxisTicks x_ticks = fitting_ticks(x, width, false), y_ticks = fitting_ticks(y, height, true);
  const double line = 1.4 * title_text;
  FrameMargins margins;
  margins.left = tick_length + label_gap + widest(y_ticks.labels) + title_gap + line;
  margins.bottom = tick_length + label_gap + tick_text + title_gap + line;
  margins.right = 0.5 * widest(x_ticks.labels);  // the last label may be centred on the corner
  margins.top = 0.7 * tick_text;
  return margins;
}

void draw_grid(Canvas& canvas, const Plot& plot) {
  const Pen pen{.colour = {228, 228, 228}};
  for (const double tick : fitting_ticks(plot.x, plot.box.width, false).major) {
    const double x = plot.box.x + plot.box.width * plot.x.fraction(tick);
    canvas.line({x, plot.box.y}, {x, plot.box.top()}, pen);
  }
  for (const double tick : fitting_ticks(plot.y, plot.box.height, true).major) {
    const double y = plot.box.y + plot.box.height * plot.y.fraction(tick);
    canvas.line({plot.box.x, y}, {plot.box.right(), y}, pen);
  }
}

void draw_frame(Canvas& canvas, const Plot& plot) {
  canvas.frame(plot.box, frame_pen);
  draw_x_axis(canvas, plot, fitting_ticks(plot.x, plot.box.width, false));
  draw_y_axis(canvas, plot, fitting_ticks(plot.y, plot.box.height, true));
}

}  // namespace porosph::render
