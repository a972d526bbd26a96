// Circular slip surfaces between two points of the ground.
#pragma once

#include <optional>

#include "solver/reference/limit_equilibrium/slices.hpp"

namespace porosph::limit_equilibrium {

/// The lower arc from a to b, a lower and to the left. `half` is half of the angle that it spans [rad].
class Arc {
 public:
  Arc(const Point& a, const Point& b, double half);

  const Point& from() const { return a_; }
  const Point& to() const { return b_; }
  const Point& centre() const { return centre_; }
  double radius() const { return radius_; }
  double y(double x) const;
  /// As many chords as slices are wanted, and further corners where the section has them.
  SlipSurface points(const Section& section, int slices) const;

 private:
  Point a_, b_;  ///< [m]
  double half_;  ///< [rad]
  Point centre_;
  double radius_;
};

/// The spans of arcs from a to b that stay below the ground and above the floor, and are nowhere steeper than
/// what can slide. `keep_floor`: false leaves the floor out of account.
struct Spans {
  double least, most;  ///< half of the angle [rad]
};
std::optional<Spans> possible_spans(const Section& section, const Point& a, const Point& b,
                                    bool keep_floor = true);

}  // namespace porosph::limit_equilibrium
