// The outlines of the soils, and where straight lines leave the soil through them.
#pragma once

#include <vector>

#include "solver/case/case.hpp"
#include "solver/space/tensor.hpp"

namespace porosph {

/// As they are at the start.
class SoilOutlines {
 public:
  SoilOutlines() = default;
  SoilOutlines(const std::vector<SoilCase>& soils, double spacing);  ///< of the particles [m]

  struct Edge {
    Vec2 a, b;
  };
  /// Where a line leaves the soil: all edges that meet there, and the one through which it comes back.
  struct Exit {
    std::vector<const Edge*> out;
    const Edge* back = nullptr;
    Vec2 at = Vec2::Zero();
    bool stays() const { return out.empty(); }
  };
  Exit exit(const Vec2& from, const Vec2& to) const;
  /// False where the line stays in the soil, or passes around a corner that leaves more than 60 degrees free.
  bool hides(const Exit& exit) const;

  bool in_soil(const Vec2& p) const;     ///< inside or on an outline
  double distance(const Vec2& p) const;  ///< to the nearest edge [m]

 private:
  std::vector<Edge> edges_;
  std::vector<std::vector<Polygon>> rings_;  ///< of each soil: outline, then holes
  double spacing_ = 0;
};

/// Whether the segments p q and a b have a point in common; false where they are parallel.
bool segments_cross(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b);
double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b);

}  // namespace porosph
