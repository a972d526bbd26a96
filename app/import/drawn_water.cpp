#include "app/import/drawn_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/case/shapes.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::drawn {
namespace {

constexpr double near_an_end = 1e-3;  // over the width of the section

/// y of a line where it reaches x, or its end near there.
std::optional<double> height_at(double x, const Polygon& line, double near) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto [left, right] =
        std::minmax(line[i], line[i + 1], [](const Point& a, const Point& b) { return a.x() < b.x(); });
    if (x < left.x() - near || x > right.x() + near || left.x() == right.x()) continue;
    const double t = std::clamp((x - left.x()) / (right.x() - left.x()), 0.0, 1.0);
    return left.y() + t * (right.y() - left.y());
  }
  return std::nullopt;
}

void add_level(const Point& a, const Point& b, double snap, std::vector<WaterLine>& water, bool goes_on) {
  const auto [left, right] = std::minmax(a.x(), b.x());
  if (goes_on && !water.empty() && std::abs(water.back().level - a.y()) <= snap) {
    water.back().x_from = std::min(water.back().x_from, left);
    water.back().x_to = std::max(water.back().x_to, right);
  } else {
    water.push_back({left, right, a.y()});
  }
}

/// Whether a point lies in the soil, given to a tolerance.
bool is_below_ground(const Point& p, double snap, const Ground& ground) {
  return std::ranges::any_of(ground.soils, [&](const SoilCase& soil) { return distance(p, soil) <= snap; });
}

void add_line(const Polygon& line, double snap, Ground& ground) {
  bool goes_on = false, falls = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point &a = line[i], &b = line[i + 1];
    const bool level = std::abs(a.y() - b.y()) <= snap;
    if (level) add_level(a, b, snap, ground.water, goes_on);
    if (!level && !is_below_ground((a + b) / 2, snap, ground))
      throw DrawingError(
          fmt::format("water falls from {} to {} m above the ground: only level water can "
                      "stand there",
                      place_text(a), place_text(b)));
    goes_on = level;
    falls = falls || !level;
  }
  if (falls)
    ground.notes.push_back(
        fmt::format("water falls from {} to {} m: taken as steady flow between the "
                    "levels at its ends; "
                    "the case computes the water table between them, which need not be the one drawn",
                    place_text(line.front()), place_text(line.back())));
}

/// Bottom and top of the soil at an end of the section.
std::pair<double, double> end_of_section(const Ground& ground, bool left, const Box& box) {
  double bottom = never, top = -never;
  for (const Stretch& s : ground.outline) {
    const bool at_left = std::abs(s.from.x() - box.low.x()) < std::abs(s.from.x() - box.high.x());
    if (s.side != Side::flank || at_left != left) continue;
    bottom = std::min({bottom, s.from.y(), s.to.y()});
    top = std::max({top, s.from.y(), s.to.y()});
  }
  return {bottom, top};
}

}  // namespace

Box box_of(const Ground& ground) {
  Box box;
  for (const SoilCase& soil : ground.soils)
    for (const Point& p : soil.polygon) box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
  return box;
}

void add_water_lines(const std::vector<Polygon>& lines, double snap, Ground& ground) {
  const Box box = box_of(ground);
  const double near = std::max(snap, near_an_end * (box.high.x() - box.low.x()));
  for (const Polygon& line : lines) {
    add_line(line, snap, ground);
    for (const bool left : {true, false}) {
      const auto [bottom, top] = end_of_section(ground, left, box);
      const auto y = height_at(left ? box.low.x() : box.high.x(), line, near);
      if (y && *y > bottom && *y < top - snap) ground.end_levels.push_back({left, *y});
    }
    for (const Point& end : {line.front(), line.back()}) {
      const bool at_an_end = end.x() <= box.low.x() + near || end.x() >= box.high.x() - near;
      const bool at_surface = !is_below_ground(end + Point(0, 2 * near), snap, ground) ||
                              !is_below_ground(end + Point(2 * near, 0), snap, ground) ||
                              !is_below_ground(end - Point(2 * near, 0), snap, ground);
      if (!at_an_end && !at_surface)
        ground.notes.push_back(
            fmt::format("the water line ends in the soil at ({:g}, {:g}) m: the case computes where the "
                        "water goes from there",
                        end.x(), end.y()));
    }
  }
}

bool has_water(const Ground& ground) { return !ground.water.empty() || !ground.end_levels.empty(); }

bool stands_still(const Ground& ground) {
  const Box box = box_of(ground);
  const double near = near_an_end * (box.high.x() - box.low.x());
  return ground.water.size() == 1 && ground.water[0].x_from <= box.low.x() + near &&
         ground.water[0].x_to >= box.high.x() - near;
}

const WaterLine* water_beside(const Stretch& stretch, const std::vector<WaterLine>& water) {
  const auto [left, right] = std::minmax(stretch.from.x(), stretch.to.x());
  const WaterLine* highest = nullptr;
  for (const WaterLine& line : water) {
    const double shared = std::min(right, line.x_to) - std::max(left, line.x_from);
    const bool below = std::min(stretch.from.y(), stretch.to.y()) < line.level;
    if (shared > 1e-6 && below && (highest == nullptr || line.level > highest->level)) highest = &line;
  }
  return highest;
}

const EndLevel* end_level(const Stretch& stretch, const Ground& ground) {
  if (stretch.side != Side::flank) return nullptr;
  const Box box = box_of(ground);
  const bool is_left = std::abs(stretch.from.x() - box.low.x()) < std::abs(stretch.from.x() - box.high.x());
  const auto at = std::ranges::find(ground.end_levels, is_left, &EndLevel::is_left);
  return at == ground.end_levels.end() ? nullptr : &*at;
}

void require_something_drives(const Ground& ground) {
  if (!has_water(ground) || stands_still(ground) || !ground.end_levels.empty()) return;
  const bool stands = std::ranges::any_of(ground.outline, [&](const Stretch& stretch) {
    return stretch.side == Side::surface && water_beside(stretch, ground.water) != nullptr;
  });
  if (!stands)
    throw DrawingError(
        "water is drawn over a part of the section, but it neither stands on the ground nor reaches an end "
        "of "
        "the section within the soil: no level drives its flow");
}

}  // namespace porosph::drawn
