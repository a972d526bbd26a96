#include "render/run/water_around.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace porosph::render {
namespace {

struct Box {
  Point low = Point::Constant(never), high = Point::Constant(-never);
};

Box box_of(const Case& scene) {
  Box box;
  for (const SoilCase& soil : scene.soils)
    for (const Point& p : soil.polygon) box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
  return box;
}

}  // namespace

std::vector<WaterStretch> water_beside_faces(const Case& scene) {
  const Box box = box_of(scene);
  const double tolerance = 1e-3 * scene.particles.spacing;
  std::vector<WaterStretch> water;
  for (const HydraulicFaceCase& face : scene.water.faces) {
    if (face.kind != FaceKind::head || face.everywhere()) continue;
    Point from = face.from, to = face.to;
    if (from.y() > to.y()) std::swap(from, to);
    const bool below_the_soil = to.y() <= box.low.y() + tolerance;
    if (below_the_soil || from.y() >= face.level - tolerance) continue;
    if (to.y() > face.level) to = from + (face.level - from.y()) / (to.y() - from.y()) * (to - from);
    const auto [left, right] = std::minmax({from.x(), to.x()});
    water.push_back({left <= box.low.x() + tolerance ? -never : left,
                     right >= box.high.x() - tolerance ? never : right, face.level});
  }
  return water;
}

std::vector<std::vector<Point>> water_table(std::span<const Point> positions,
                                            std::span<const double> pressure_head, double spacing) {
  std::map<long, std::vector<std::size_t>> columns;
  for (std::size_t i = 0; i < positions.size(); ++i)
    columns[std::lround(std::floor(positions[i].x() / spacing))].push_back(i);
  std::vector<std::vector<Point>> lines;
  long last = 0;
  for (auto& [column, members] : columns) {
    std::ranges::sort(members,
                      [&](std::size_t a, std::size_t b) { return positions[a].y() > positions[b].y(); });
    for (std::size_t k = 0; k + 1 < members.size(); ++k) {
      const std::size_t above = members[k], below = members[k + 1];
      const double dry = pressure_head[above], wet = pressure_head[below];
      if (!(dry < 0 && wet >= 0)) continue;
      const Point place = positions[below] + wet / (wet - dry) * (positions[above] - positions[below]);
      if (lines.empty() || column != last + 1) lines.emplace_back();
      lines.back().push_back(place);
      last = column;
      break;
    }
  }
  return lines;
}

}  // namespace porosph::render
