#include "render/particle_patches.hpp"

#include <algorithm>
#include <array>

#include "render/picture.hpp"

namespace porosph::render {
namespace {

bool inside(const Box& box, Pixel at) {
  return at.x >= box.x && at.x <= box.right() && at.y >= box.y && at.y <= box.top();
}

void add_box(Patches& patches, const Box& box, const Colour& colour) {
  patches.add(
      std::array<Pixel, 4>{
          {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.top()}, {box.x, box.top()}}},
      colour);
}

}  // namespace

Patches particle_patches(const Plot& plot, const std::vector<Point>& positions,
                         const std::vector<double>& sizes, const std::vector<Polygon>& outlines,
                         const std::vector<Colour>& colours) {
  const bool as_points = positions.size() > most_quads;
  const Pixel per_metre{plot.box.width / (plot.x.high - plot.x.low),
                        plot.box.height / (plot.y.high - plot.y.low)};
  Patches patches{.area = plot.box, .dot = 0, .corners = {}, .ends = {}, .colours = {}};
  if (as_points) patches.dot = std::max(per_metre.x, per_metre.y) * *std::ranges::max_element(sizes);
  std::vector<Pixel> cell;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Pixel at = plot.at(positions[i].x(), positions[i].y());
    if (!inside(plot.box, at)) continue;  // not finite, or so far off that VTK would lose the others' digits
    const Pixel local{at.x - plot.box.x, at.y - plot.box.y};
    if (as_points) {
      patches.add(std::span(&local, 1), colours[i]);
    } else if (!outlines.empty() && !outlines[i].empty()) {
      cell.clear();
      for (const Point& corner : outlines[i])
        cell.push_back({local.x + per_metre.x * corner.x(), local.y + per_metre.y * corner.y()});
      patches.add(cell, colours[i]);
    } else {
      const double side = sizes.size() == 1 ? sizes[0] : sizes[i];
      const double width = per_metre.x * side, height = per_metre.y * side;
      add_box(patches, {local.x - 0.5 * width, local.y - 0.5 * height, width, height}, colours[i]);
    }
  }
  return patches;
}

Patches water_patches(const Plot& plot, const std::vector<WaterStretch>& water, double x_from, double x_to,
                      double bottom) {
  Patches patches{.area = plot.box, .dot = 0, .corners = {}, .ends = {}, .colours = {}};
  for (const WaterStretch& stretch : water) {
    const Pixel low = plot.at(std::max(stretch.x_from, x_from), bottom);
    const Pixel high = plot.at(std::min(stretch.x_to, x_to), stretch.level);
    if (low.x < high.x && low.y < high.y)
      add_box(patches, {low.x - plot.box.x, low.y - plot.box.y, high.x - low.x, high.y - low.y},
              {222, 236, 250});
  }
  return patches;
}

}  // namespace porosph::render
