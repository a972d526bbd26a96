#include "render/field_marks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "render/nice_ticks.hpp"

namespace porosph::render {
namespace {

const Colour compression{20, 40, 110}, tension{200, 20, 30}, arrow_colour{25, 25, 25};

double length_of(const std::vector<Pixel>& line) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    length += std::hypot(line[i + 1].x - line[i].x, line[i + 1].y - line[i].y);
  return length;
}

Pixel point_at(const std::vector<Pixel>& line, double distance) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = std::hypot(line[i + 1].x - line[i].x, line[i + 1].y - line[i].y);
    if (distance <= step && step > 0)
      return {line[i].x + distance / step * (line[i + 1].x - line[i].x),
              line[i].y + distance / step * (line[i + 1].y - line[i].y)};
    distance -= step;
  }
  return line.back();
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.top() && b.y < a.top();
}

/// One label on a line, where it is in the frame and hides nothing that is taken.
void label_line(Canvas& canvas, const Box& frame, const std::vector<Pixel>& line, const std::string& label,
                std::vector<Box>& taken) {
  constexpr double size = 11, margin = 3;
  const Pixel extent = text_extent(label, size);
  const double length = length_of(line);
  if (length < 3 * extent.x) return;
  for (const double part : {0.5, 0.35, 0.65, 0.2, 0.8}) {
    const Pixel at = point_at(line, part * length);
    const Box box{at.x - 0.5 * extent.x - margin, at.y - 0.5 * size - margin, extent.x + 2 * margin,
                  size + 2 * margin};
    const bool is_inside =
        box.x > frame.x && box.right() < frame.right() && box.y > frame.y && box.top() < frame.top();
    if (!is_inside || std::ranges::any_of(taken, [&](const Box& other) { return overlap(box, other); }))
      continue;
    taken.push_back(box);
    canvas.text(at, label, {.size = size, .halo = true});
    return;
  }
}

/// Numbers of particles no nearer to each other than mark_spacing, in their order: every second or third one
/// of a lattice.
std::vector<std::size_t> spread(const Plot& plot, const std::vector<Point>& at) {
  std::map<std::pair<int, int>, std::vector<Pixel>> cells;  // chosen ones
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Pixel p = plot.at(at[i].x(), at[i].y());
    if (!(p.x >= plot.box.x && p.x <= plot.box.right() && p.y >= plot.box.y && p.y <= plot.box.top()))
      continue;
    const int column = static_cast<int>(p.x / mark_spacing), row = static_cast<int>(p.y / mark_spacing);
    bool is_free = true;
    for (int r = row - 1; r <= row + 1 && is_free; ++r)
      for (int c = column - 1; c <= column + 1 && is_free; ++c)
        if (const auto cell = cells.find({r, c}); cell != cells.end())
          is_free = std::ranges::none_of(
              cell->second, [&](const Pixel& q) { return std::hypot(q.x - p.x, q.y - p.y) < mark_spacing; });
    if (!is_free) continue;
    cells[{row, column}].push_back(p);
    chosen.push_back(i);
  }
  return chosen;
}

/// A direction of the plane as it appears on the picture, of length 1.
Pixel on_picture(const Plot& plot, const Point& direction) {
  const double x = direction.x() * plot.box.width / (plot.x.high - plot.x.low),
               y = direction.y() * plot.box.height / (plot.y.high - plot.y.low), length = std::hypot(x, y);
  return length > 0 ? Pixel{x / length, y / length} : Pixel{};
}

void draw_arrow(Canvas& canvas, Pixel from, Pixel along, double length) {
  const double head = std::min(6.0, 0.45 * length);
  const Pixel to{from.x + length * along.x, from.y + length * along.y}, across{-along.y, along.x};
  const auto corner = [&](double side) {
    return Pixel{to.x - head * along.x + side * across.x, to.y - head * along.y + side * across.y};
  };
  canvas.line(from, {to.x - 0.8 * head * along.x, to.y - 0.8 * head * along.y},
              {.colour = arrow_colour, .width = 1.3});
  canvas.polygon(std::vector<Pixel>{to, corner(0.4 * head), corner(-0.4 * head)}, {.colour = arrow_colour});
}

struct Principal {
  double first, second;  ///< largest first
  Point direction;       ///< of the first
};

Principal principal_of(const Stress& s) {
  const double middle = 0.5 * (s.xx + s.yy), radius = std::hypot(0.5 * (s.xx - s.yy), s.xy);
  const double angle = 0.5 * std::atan2(2 * s.xy, s.xx - s.yy);
  return {middle + radius, middle - radius, {std::cos(angle), std::sin(angle)}};
}

}  // namespace

void draw_isolines(Canvas& canvas, const Box& frame, const TriangleField& field,
                   std::span<const double> levels, std::vector<Box> taken) {
  const std::vector<std::string> labels = linear_tick_labels({levels.begin(), levels.end()}).labels;
  std::vector<std::vector<std::vector<Pixel>>> lines;
  for (const double level : levels) {
    lines.push_back(isolines(field, level));
    const bool is_zero = std::abs(level) < 1e-9 * (levels.back() - levels.front() + std::abs(levels.front()));
    for (const auto& line : lines.back())
      canvas.line(line,
                  is_zero ? Pen{.colour = black, .width = 2.2} : Pen{.colour = {60, 60, 60}, .width = 0.8});
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const auto& line : lines[i]) label_line(canvas, frame, line, labels[i], taken);
}

void draw_arrows(Canvas& canvas, const Plot& plot, const std::vector<Point>& at,
                 const std::vector<Point>& vectors) {
  const std::vector<std::size_t> chosen = spread(plot, at);
  double largest = 0;
  for (const std::size_t i : chosen)
    if (vectors[i].allFinite()) largest = std::max(largest, vectors[i].norm());
  constexpr double shortest = 3;  // [pixels]; a shorter one is not drawn
  for (const std::size_t i : chosen) {
    const double length = mark_spacing * vectors[i].norm() / largest;
    if (length >= shortest)
      draw_arrow(canvas, plot.at(at[i].x(), at[i].y()), on_picture(plot, vectors[i]), length);
  }
}

void draw_crosses(Canvas& canvas, const Plot& plot, const std::vector<Point>& at,
                  const std::vector<Stress>& stresses) {
  const std::vector<std::size_t> chosen = spread(plot, at);
  double largest = 0;
  for (const std::size_t i : chosen) {
    const Principal p = principal_of(stresses[i]);
    if (std::isfinite(p.first) && std::isfinite(p.second))
      largest = std::max({largest, std::abs(p.first), std::abs(p.second)});
  }
  constexpr double longest = 0.92 * mark_spacing;
  for (const std::size_t i : chosen) {
    const Principal p = principal_of(stresses[i]);
    const Pixel middle = plot.at(at[i].x(), at[i].y());
    const auto draw = [&](double value, const Point& direction) {
      const double half = 0.5 * longest * std::abs(value) / largest;
      if (!(half >= 0.5)) return;
      const Pixel along = on_picture(plot, direction);
      for (const Pen& pen :
           {Pen{.colour = white, .width = 4}, Pen{.colour = value > 0 ? tension : compression, .width = 2}})
        canvas.line({middle.x - half * along.x, middle.y - half * along.y},
                    {middle.x + half * along.x, middle.y + half * along.y}, pen);
    };
    draw(p.first, p.direction);
    draw(p.second, {-p.direction.y(), p.direction.x()});
  }
}

void draw_outlines_before(Canvas& canvas, const Plot& plot, const std::vector<SoilOutline>& soils) {
  const auto draw = [&](const Polygon& ring) {
    if (ring.empty()) return;
    std::vector<Pixel> line;
    for (const Point& p : ring) line.push_back(plot.at(p.x(), p.y()));
    line.push_back(line.front());
    canvas.line(line, {.colour = {110, 110, 110}, .width = 1, .dashes = {5, 4}});
  };
  for (const SoilOutline& soil : soils) {
    draw(soil.polygon);
    for (const Polygon& hole : soil.holes) draw(hole);
  }
}

}  // namespace porosph::render
