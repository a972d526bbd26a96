// Paths that turn back at walls: which images behind walls a place sees, whatever the walls' angles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/wall.hpp"

namespace porosph {

/// A place sees an image along a straight line. Where the line crosses a wall the rest of it, mirrored back,
/// is a path within the soil that turns at the wall like light at a mirror: the image of b in walls u, v, ...
/// (the first is the one crossed first) is seen from a where the path from a turns at u, at v, ..., reaches
/// b, and meets no other wall on its way. As each direction and length belong to one path, each place sees
/// one thing there and nothing twice, at convex, obtuse, acute and re-entrant corners, around thin walls and
/// in narrow passages; and a sees an image of b where b sees that image of a, as a path may be walked back.
class WallPaths {
 public:
  WallPaths() = default;
  /// `walls` reach as far as the soil's outline does; `range` [m] is the longest path.
  WallPaths(std::vector<Wall> walls, double range);

  /// Walls that stand alone, that continue each other or meet at a right angle with the soil between them,
  /// and none of `points` lies behind one within the range: every image is in sight, and append_images makes
  /// all.
  bool all_in_sight(std::span<const Vec2> points) const;

  /// Numbers of the walls within the range of a place: paths from there meet no others.
  std::vector<std::int32_t> near(const Vec2& place) const;

  /// No wall lies across the line. To pass the end of a wall at a re-entrant corner is allowed.
  bool clear(const Vec2& from, const Vec2& to, std::span<const std::int32_t> near) const;

  /// The line from a place to the image at `at`, number `image` of `images` of `particles` particles, is such
  /// a path.
  bool leads(const Vec2& from, const Vec2& at, std::size_t image, std::span<const Image> images,
             std::size_t particles, std::span<const std::int32_t> near) const;

  /// Appends to `points` the images that one of them sees, and those that they are images of.
  std::vector<Image> append_seen_images(std::vector<Vec2>& points) const;

 private:
  struct End {
    Vec2 at = Vec2::Zero();
    bool owned = true;      ///< what crosses just here crosses this wall: the first of those that meet
    std::int32_t met = -1;  ///< the wall that meets this one at an angle
    bool convex = false;    ///< with the soil between them
    bool right = false;     ///< at a right angle
    bool corner() const { return met >= 0; }
  };
  End end_of(std::size_t wall, const Vec2& at) const;
  bool crosses(std::size_t wall, const Vec2& at, const Vec2& beyond, const Vec2& turned_at) const;
  double distance(std::size_t wall, const Vec2& place) const;
  std::vector<Image> candidates(std::vector<Vec2>& points) const;

  std::vector<Wall> walls_;
  std::vector<std::array<End, 2>> ends_;
  double range_ = 0, slack_ = 0;
};

}  // namespace porosph
