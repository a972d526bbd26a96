#include "render/canvas.hpp"

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>

#include "render/canvas_device.hpp"
#include "render/vtk_device.hpp"
#include "solver/printable.hpp"

namespace porosph::render {

namespace {

constexpr double subscript_size = 0.74, subscript_drop = 0.26, subscript_gap = 0.06;  // of the text's size

struct TextPart {
  std::string text;
  bool lowered = false;
};

/// The pieces before, within and after each "_{...}".
std::vector<TextPart> parts_of(const std::string& text) {
  std::vector<TextPart> parts;
  std::size_t begin = 0;
  for (std::size_t open; (open = text.find("_{", begin)) != std::string::npos;) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) break;
    if (open > begin) parts.push_back({text.substr(begin, open - begin)});
    parts.push_back({text.substr(open + 2, close - open - 2), true});
    begin = close + 1;
  }
  if (begin < text.size() || parts.empty()) parts.push_back({text.substr(begin)});
  return parts;
}

double part_size(const TextPart& part, double size) { return part.lowered ? subscript_size * size : size; }

Pixel plain_extent(const std::string& text, double size) {
  constexpr double fine = 8;  // measured large, so that whole device pixels do not round the answer
  vtkNew<vtkTextProperty> property;
  apply(*property, {.size = size}, fine);
  int bounds[4] = {0, 0, 0, 0};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, vtkStdString(text), bounds, 72);
  return {(bounds[1] - bounds[0]) / fine, (bounds[3] - bounds[2]) / fine};
}

}  // namespace

Pixel text_extent(const std::string& text, double size) {
  Pixel extent;
  const std::vector<TextPart> parts = parts_of(text);
  for (const TextPart& part : parts) {
    const Pixel box = plain_extent(part.text, part_size(part, size));
    extent.x += box.x + (parts.size() > 1 ? subscript_gap * size : 0);
    extent.y = std::max(extent.y, box.y);
  }
  return extent;
}

double fitting_size(const std::string& text, double size, double width) {
  const double natural = text_extent(text, size).x;
  return natural > width ? std::floor(2 * size * width / natural) / 2 : size;
}

std::vector<std::vector<Pixel>> dashed(std::span<const Pixel> line, std::span<const double> pattern) {
  std::vector<std::vector<Pixel>> parts;
  std::size_t dash = 0;
  double left = pattern[0];  // of the present dash or gap
  const auto drawing = [&] { return dash % 2 == 0; };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Pixel a = line[i], b = line[i + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const auto along = [&](double s) {
      return Pixel{a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)};
    };
    if (i == 0) parts.push_back({a});
    double done = 0;
    while (length - done > left) {
      done += left;
      if (drawing())
        parts.back().push_back(along(done));
      else
        parts.push_back({along(done)});
      dash = (dash + 1) % (pattern.size() % 2 == 0 ? pattern.size() : 2 * pattern.size());
      left = pattern[dash % pattern.size()];
    }
    left -= length - done;
    if (drawing()) parts.back().push_back(b);
  }
  std::erase_if(parts, [](const auto& part) { return part.size() < 2; });
  return parts;
}

void Canvas::line(std::span<const Pixel> points, const Pen& pen) {
  if (points.size() < 2) return;
  if (pen.dashes.empty()) return device_.polyline(points, pen.colour, pen.width);
  for (const auto& part : dashed(points, pen.dashes)) device_.polyline(part, pen.colour, pen.width);
}

void Canvas::line(Pixel from, Pixel to, const Pen& pen) { line(std::vector{from, to}, pen); }

void Canvas::polygon(std::span<const Pixel> points, const Fill& fill) { device_.polygon(points, fill); }

void Canvas::box(const Box& box, const Fill& fill) {
  polygon(
      std::vector<Pixel>{{box.x, box.y}, {box.right(), box.y}, {box.right(), box.top()}, {box.x, box.top()}},
      fill);
}

void Canvas::frame(const Box& box, const Pen& pen) {
  const double reach = 0.5 * pen.width;  // closes the corners
  line({box.x - reach, box.y}, {box.right() + reach, box.y}, pen);
  line({box.x - reach, box.top()}, {box.right() + reach, box.top()}, pen);
  line({box.x, box.y}, {box.x, box.top()}, pen);
  line({box.right(), box.y}, {box.right(), box.top()}, pen);
}

void Canvas::disc(Pixel centre, double radius, const Fill& fill, const Pen& edge) {
  constexpr int corners = 32;
  std::vector<Pixel> circle;
  for (int i = 0; i <= corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    circle.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  polygon(std::span(circle).first(corners), fill);
  line(circle, edge);
}

void Canvas::plain_text(Pixel at, const std::string& text, const TextStyle& style) {
  if (!text.empty()) device_.text(at, printable_lines(text), style);
}

void Canvas::text(Pixel at, const std::string& text, const TextStyle& style) {
  if (style.halo) {
    TextStyle rim = style;
    rim.halo = false;
    rim.colour = white;
    for (const double dx : {-1.5, 0., 1.5})
      for (const double dy : {-1.5, 0., 1.5})
        if (dx != 0 || dy != 0) this->text({at.x + dx, at.y + dy}, text, rim);
  }
  const std::vector<TextPart> parts = parts_of(text);
  if (parts.size() == 1 && !parts[0].lowered) return plain_text(at, text, style);
  const double length = text_extent(text, style.size).x;
  double done = style.horizontal == Align::low      ? 0
                : style.horizontal == Align::centre ? -0.5 * length
                                                    : -length;
  for (const TextPart& part : parts) {
    TextStyle own = style;
    own.size = part_size(part, style.size);
    own.horizontal = Align::low;
    own.halo = false;
    const double drop = part.lowered ? subscript_drop * style.size : 0;
    plain_text(style.upright ? Pixel{at.x + drop, at.y + done} : Pixel{at.x + done, at.y - drop}, part.text,
               own);
    done += text_extent(part.text, own.size).x + subscript_gap * style.size;
  }
}

void Canvas::clip(const Box& box) { device_.clip(box); }

void Canvas::unclip() { device_.unclip(); }

}  // namespace porosph::render
