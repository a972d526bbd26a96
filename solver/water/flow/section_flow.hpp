// What flows through a line in the soil.
#pragma once

#include <span>
#include <vector>

#include "solver/water/flow/darcy_flow.hpp"

namespace porosph {

/// The sum over all pairs of particles on either side: a line from outline to outline passes exactly what
/// enters on the one side and leaves on the other.
class SectionFlow {
 public:
  SectionFlow(const FlowSectionCase& section, const DarcyFlow& flow, std::span<const Vec2> position);

  /// From the left of the line to its right [m2/s].
  double discharge(const DarcyFlow& flow, std::span<const double> head, const FaceConditions& faces) const;

 private:
  struct Pair {
    std::int32_t left, right;
    double conductance;
    std::int64_t face_pair;  ///< -1: a pair of particles
  };
  std::vector<Pair> pairs_;
};

}  // namespace porosph
