#include "render/upright_lines.hpp"

#include <cmath>

#include "render/chart_range.hpp"
#include "render/line_style.hpp"

namespace porosph::render {
namespace {

constexpr double text_size = 12, gap = 4;  // [pixels]
constexpr Colour grey{110, 110, 110};

bool is_inside(double x, const Box& frame) { return x >= frame.x && x <= frame.right(); }

}  // namespace

std::vector<Box> label_boxes(const std::vector<UprightLine>& uprights, const Plot& plot) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < uprights.size(); ++i) {
    Box box{0, 0, 0, 0};
    if (showable(plot.x, uprights[i].x)) {
      const Pixel size = text_extent(uprights[i].label, text_size);
      box = {plot.at(uprights[i].x, plot.y.low).x + gap, plot.box.top() - gap - size.y, size.x, size.y};
      const bool next_is_near = i + 1 < uprights.size() && showable(plot.x, uprights[i + 1].x) &&
                                box.right() > plot.at(uprights[i + 1].x, plot.y.low).x;
      if (next_is_near || box.x < plot.box.x || box.right() > plot.box.right()) box.width = 0;
    }
    boxes.push_back(box);
  }
  return boxes;
}

void draw_uprights(Canvas& canvas, const std::vector<UprightLine>& uprights, const Plot& plot) {
  const std::vector<Box> boxes = label_boxes(uprights, plot);
  for (std::size_t i = 0; i < uprights.size(); ++i) {
    if (!showable(plot.x, uprights[i].x)) continue;
    const double x = std::floor(plot.at(uprights[i].x, plot.y.low).x) + 0.5;  // sharp
    if (!is_inside(x, plot.box)) continue;
    canvas.line({x, plot.box.y}, {x, plot.box.top()},
                {.colour = grey, .width = 1, .dashes = dash_pattern(LineStyle::dotted)});
    if (boxes[i].width > 0)
      canvas.text({boxes[i].x, boxes[i].top()}, uprights[i].label,
                  {.size = text_size,
                   .colour = grey,
                   .horizontal = Align::low,
                   .vertical = Align::high,
                   .halo = true});
  }
}

}  // namespace porosph::render
