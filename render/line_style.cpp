#include "render/line_style.hpp"

#include <array>

namespace porosph::render {

Colour series_colour(std::size_t i) {
  static constexpr std::array<Colour, 7> colours = {{{0, 114, 178},
                                                     {213, 94, 0},
                                                     {0, 158, 115},
                                                     {204, 121, 167},
                                                     {230, 159, 0},
                                                     {86, 180, 233},
                                                     {20, 20, 20}}};
  return colours[i % colours.size()];
}

std::vector<double> dash_pattern(LineStyle style) {
  if (style == LineStyle::dashed) return {8, 5};
  if (style == LineStyle::dotted) return {2, 4};
  if (style == LineStyle::dash_dotted) return {9, 4, 2, 4};
  return {};
}

void draw_marker(Canvas& canvas, Pixel at, Marker marker, const Colour& colour) {
  constexpr double r = 4.5;
  const auto shape = [&](const std::vector<Pixel>& offsets) {
    std::vector<Pixel> corners;
    for (const Pixel& offset : offsets) corners.push_back({at.x + r * offset.x, at.y + r * offset.y});
    canvas.polygon(corners, {.colour = colour});
    corners.push_back(corners.front());
    canvas.line(corners, {.colour = white, .width = 0.8});
  };
  if (marker == Marker::circle) canvas.disc(at, r, {.colour = colour}, {.colour = white, .width = 0.8});
  if (marker == Marker::square) shape({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
  if (marker == Marker::triangle) shape({{-1.1, -0.8}, {1.1, -0.8}, {0, 1.2}});
  if (marker == Marker::diamond) shape({{0, -1.25}, {1.25, 0}, {0, 1.25}, {-1.25, 0}});
}

}  // namespace porosph::render
