#include "render/legend.hpp"

#include <algorithm>
#include <cmath>

namespace porosph::render {

namespace {

constexpr double text_size = 13, row = 20, sample = 30, gap = 8, inset = 9, clearance = 6;

bool inside(const Box& box, Pixel p) {
  return p.x > box.x - clearance && p.x < box.right() + clearance && p.y > box.y - clearance &&
         p.y < box.top() + clearance;
}

bool crosses(const Box& box, const std::vector<Pixel>& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Pixel a = line[i], b = line[std::min(i + 1, line.size() - 1)];
    // Steps shorter than the clearance cannot jump over the box; far outside there is nothing to step over.
    const int steps = static_cast<int>(std::min(2000., std::hypot(b.x - a.x, b.y - a.y) / clearance)) + 1;
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      if (inside(box, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)})) return true;
    }
  }
  return false;
}

}  // namespace

Pixel legend_extent(const std::vector<LegendEntry>& entries) {
  if (entries.empty()) return {};
  double widest = 0;
  for (const LegendEntry& entry : entries) widest = std::max(widest, text_extent(entry.label, text_size).x);
  return {sample + gap + widest + 2 * inset, row * static_cast<double>(entries.size()) + inset};
}

std::optional<Box> free_corner(const Box& frame, Pixel extent, std::span<const std::vector<Pixel>> lines) {
  constexpr double margin = 8;
  const double left = frame.x + margin, right = frame.right() - margin - extent.x;
  const double bottom = frame.y + margin, top = frame.top() - margin - extent.y;
  if (right < left || top < bottom) return std::nullopt;
  for (const Pixel corner :
       {Pixel{right, top}, Pixel{right, bottom}, Pixel{left, top}, Pixel{left, bottom}}) {
    const Box box{corner.x, corner.y, extent.x, extent.y};
    if (std::ranges::none_of(lines, [&](const auto& line) { return crosses(box, line); })) return box;
  }
  return std::nullopt;
}

void draw_legend(Canvas& canvas, const Box& box, const std::vector<LegendEntry>& entries) {
  canvas.box(box, {.colour = white, .opacity = 0.9});
  canvas.frame(box, {.colour = {200, 200, 200}});
  double y = box.top() - 0.5 * inset - 0.5 * row;
  for (const LegendEntry& entry : entries) {
    const double x = box.x + inset;
    if (entry.line) canvas.line({x, y}, {x + sample, y}, entry.pen);
    draw_marker(canvas, {x + 0.5 * sample, y}, entry.marker, entry.pen.colour);
    canvas.text({x + sample + gap, y}, entry.label, {.size = text_size, .horizontal = Align::low});
    y -= row;
  }
}

}  // namespace porosph::render
