#include "solver/boundary/wall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace porosph {
namespace {

constexpr double on_line = 1e-9;  // relative to the search range

/// Towards the side on which soil lies along more of the wall; zero where it lies on neither.
Vec2 normal_by_soil(const Wall& wall, double range, const std::function<bool(const Vec2&)>& in_soil) {
  constexpr int samples = 64;
  const Vec2 tangent = (wall.to - wall.from).normalized(), left(-tangent.y(), tangent.x());
  int balance = 0;
  for (int k = 0; k < samples; ++k) {
    const Vec2 at = wall.from + (k + 0.5) / samples * (wall.to - wall.from), aside = 1e-3 * range * left;
    balance += in_soil(at + aside) - in_soil(at - aside);
  }
  return balance > 0 ? left : balance < 0 ? Vec2(-left) : Vec2(Vec2::Zero());
}

/// `number`: of the boundary in its case.
Vec2 normal_towards(const Wall& wall, std::size_t number, std::span<const Vec2> points, double range) {
  const Vec2 tangent = (wall.to - wall.from).normalized();
  Wall left = wall, right = wall;
  left.normal = Vec2(-tangent.y(), tangent.x());
  right.normal = -left.normal;
  left.kind = right.kind = BoundaryKind::fixed;  // in front of itself, also of a periodic one
  // The soil on the other side of a thin plate lies further away.
  const auto nearest = [&](const Wall& w) {
    double least = never;
    for (const Vec2& p : points)
      if (w.faces(p, range)) least = std::min(least, w.distance(p));
    return least;
  };
  const double on_left = nearest(left), on_right = nearest(right);
  if (on_left == never && on_right == never)
    throw std::runtime_error(fmt::format("boundary[{}] touches no soil particle", number));
  return on_left <= on_right ? left.normal : right.normal;
}

/// An end that another wall meets at an angle is a corner: images in the one wall have images in the other.
bool met_at(const Vec2& end, const Wall& self, std::span<const Wall> walls) {
  const Vec2 tangent = (self.to - self.from).normalized();
  return std::any_of(walls.begin(), walls.end(), [&](const Wall& other) {
    if (&other == &self) return false;
    const Vec2 direction = (other.to - other.from).normalized();
    const bool parallel = std::abs(tangent.dot(direction)) > 1 - 1e-9;
    const double along = std::clamp((end - other.from).dot(direction), 0.0, (other.to - other.from).norm());
    return !parallel && (other.from + along * direction - end).norm() < 1e-6 * (self.to - self.from).norm();
  });
}

/// An end that is also one of a later wall in line, which holds the same side of the soil.
bool passed_on_at(const Vec2& end, const Wall& self, std::span<const Wall> later) {
  return std::ranges::any_of(later, [&](const Wall& other) {
    const double near = 1e-6 * (self.to - self.from).norm();
    const bool meets = (other.from - end).norm() < near || (other.to - end).norm() < near;
    return meets && self.normal.dot(other.normal) > 1 - 1e-9;
  });
}

/// Appends images as append_images() does, which knows what the points are.
class Imaging {
 public:
  Imaging(std::span<const Wall> walls, std::vector<Vec2>& points, std::vector<Image>& images)
      : walls_(walls), points_(points), images_(images), particles_(points.size() - images.size()) {}

  void append(std::size_t w, double range, double beyond) {
    const Wall& wall = walls_[w];
    const double reach = wall.is_periodic() ? range + farthest_beyond(wall) : range;
    const std::size_t present = points_.size();
    for (std::size_t i = 0; i < present; ++i) {
      if (!wall.faces(points_[i], reach, beyond) || (wall.is_periodic() && is_copy(i))) continue;
      images_.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(w)});
      points_.push_back(wall.mirrored(points_[i]));
    }
  }

 private:
  bool is_copy(std::size_t i) const {
    return i >= particles_ && walls_[images_[i - particles_].wall].is_periodic();
  }
  /// How far soil has moved beyond a periodic side: so much more of the other side is seen behind it [m].
  double farthest_beyond(const Wall& wall) const {
    double farthest = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!is_copy(i)) farthest = std::max(farthest, -wall.distance(points_[i]));
    return farthest;
  }

  std::span<const Wall> walls_;
  std::vector<Vec2>& points_;
  std::vector<Image>& images_;
  std::size_t particles_;
};

}  // namespace

bool Wall::faces(const Vec2& p, double range, double beyond) const {
  if (is_periodic()) return shift.norm() - distance(p) < range;
  const double away = distance(p);
  if (away < on_line * range || away >= range) return false;
  const Vec2 line = to - from;
  const double length = line.norm(), along = (p - from).dot(line) / length, slack = on_line * range;
  const auto past = [&](bool continued, bool passed_on) {
    return continued ? range : beyond + (passed_on ? -slack : slack);
  };
  return along >= -past(continued_at_from, passed_on_at_from) &&
         along <= length + past(continued_at_to, passed_on_at_to);
}

std::vector<Wall> make_walls(const std::vector<BoundaryCase>& boundaries, std::span<const Vec2> points,
                             double range, const std::function<bool(const Vec2&)>& in_soil) {
  std::vector<Wall> walls;
  for (const BoundaryCase& b : boundaries)
    walls.push_back({.kind = b.kind, .friction = b.coefficient, .from = b.from, .to = b.to});
  for (std::size_t i = 0; i < walls.size(); ++i) {
    Wall& wall = walls[i];
    if (in_soil) wall.normal = normal_by_soil(wall, range, in_soil);
    if (wall.normal.isZero(0)) wall.normal = normal_towards(wall, i, points, range);
    wall.bears_weight = wall.support().carries_shear() || std::abs(wall.normal.y()) > 1e-9;
  }
  const auto rank = [](const Wall& w) {
    return w.support().carries_shear() ? 0 : w.bears_weight ? 1 : w.is_periodic() ? 3 : 2;
  };
  std::stable_sort(walls.begin(), walls.end(),
                   [&](const Wall& a, const Wall& b) { return rank(a) < rank(b); });
  for (std::size_t w = 0; w < walls.size(); ++w) {
    Wall& wall = walls[w];
    wall.continued_at_from = met_at(wall.from, wall, walls);
    wall.continued_at_to = met_at(wall.to, wall, walls);
    const std::span<const Wall> later = std::span(walls).subspan(w + 1);
    wall.passed_on_at_from = passed_on_at(wall.from, wall, later);
    wall.passed_on_at_to = passed_on_at(wall.to, wall, later);
  }
  join_sides(walls);
  return walls;
}

void join_sides(std::span<Wall> walls) {
  for (Wall& wall : walls) {
    const auto other = std::ranges::find_if(walls, [&](const Wall& w) {
      return wall.is_periodic() && w.is_periodic() && w.normal.dot(wall.normal) < 0;
    });
    if (other != walls.end()) wall.shift = -wall.distance(other->from) * wall.normal;
  }
}

std::vector<std::int32_t> roots(std::span<const Image> images, std::size_t particles) {
  const auto n = static_cast<std::int32_t>(particles);
  std::vector<std::int32_t> root;
  for (const Image& image : images) root.push_back(image.parent < n ? image.parent : root[image.parent - n]);
  return root;
}

void append_images(std::span<const Wall> walls, std::size_t first, std::size_t last, double range,
                   std::vector<Vec2>& points, std::vector<Image>& images, double beyond) {
  Imaging imaging(walls, points, images);
  for (std::size_t w = first; w < last; ++w) imaging.append(w, range, beyond);
}

}  // namespace porosph
