// A soil's place in the plane: a polygon with holes.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// A polygon with holes, checked. Rings are kept open; the outline runs counter-clockwise, holes clockwise,
/// so that sums over the edges of all rings are integrals over the region.
class Region {
 public:
  /// Throws std::invalid_argument, saying what is wrong, if the outline crosses itself, has no area, or the
  /// holes are not apart from each other and inside of the outline.
  explicit Region(Polygon outline, std::vector<Polygon> holes = {});

  const std::vector<Polygon>& rings() const { return rings_; }         ///< the outline, then the holes
  Point lower_left() const { return lower_left_; }                     ///< of the bounding box [m]
  Point upper_right() const { return upper_right_; }                   ///< of the bounding box [m]
  double size() const { return (upper_right_ - lower_left_).norm(); }  ///< diagonal of the bounding box [m]

  double area() const;                               ///< holes taken off [m2]
  Point centroid() const;                            ///< of the area [m]
  double distance_to_outline(const Point& p) const;  ///< to the nearest point of any ring [m]
  bool contains(const Point& p) const;               ///< inside, or within 1e-9 size() of a ring
  /// What lies in an upright box: of each piece that hangs together, outline and holes.
  std::vector<std::vector<Polygon>> parts_within(const Point& low, const Point& high) const;
  /// The place itself if it is inside; else one near it that is inside by about `depth` [m].
  Point nearest_inside(const Point& p, double depth) const;
  double overlap(const Region& other) const;  ///< area in common [m2]

 private:
  std::vector<Polygon> rings_;
  Point lower_left_, upper_right_;
};

}  // namespace porosph
