#include "solver/reference/fem/triangle_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solver/water/standing_water.hpp"

namespace porosph {

WaterBeside water_beside(const WaterCase& water, const Point& from, const Point& to, const Point& middle,
                         double beside) {
  const double outward = (to.y() - from.y()) / (to - from).norm();
  const int outside = stretch_at(water.stretches, (from.x() + to.x()) / 2 + beside * outward);
  const int inside = stretch_at(water.stretches, middle.x());
  if (outside < 0 || outside == inside) return {};
  return {&water.stretches[outside], water.unit_weight};
}

std::vector<TriangleWater> water_of_triangles(const WaterCase& water, const Mesh& mesh) {
  const double tiny = 1e-8 * extent(mesh.vertices);
  std::vector<TriangleWater> all(mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const auto [left, right] =
        std::minmax({mesh.vertices[v[0]].x(), mesh.vertices[v[1]].x(), mesh.vertices[v[2]].x()});
    const auto [low, high] =
        std::minmax({mesh.vertices[v[0]].y(), mesh.vertices[v[1]].y(), mesh.vertices[v[2]].y()});
    const auto cut = [x = left, y = low](const char* what, double where) {
      throw std::runtime_error(
          fmt::format("mesh: {} at {} m cuts through the triangle around ({}, {}); the mesh must follow it",
                      what, where, x, y));
    };
    for (const WaterStretch& stretch : water.stretches) {
      if (right <= stretch.x_from + tiny || left >= stretch.x_to - tiny) continue;
      if (low >= stretch.level - tiny) continue;
      if (left < stretch.x_from - tiny) cut("the start of a water stretch, x", stretch.x_from);
      if (right > stretch.x_to + tiny) cut("the end of a water stretch, x", stretch.x_to);
      if (high > stretch.level + tiny) cut("the water level, y", stretch.level);
      all[t] = {true, stretch.level, water.unit_weight};
      break;
    }
  }
  return all;
}

}  // namespace porosph
