// Pore water in steady flow, which the soil comes to rest in.
#pragma once

#include "solver/water/flowing_water.hpp"

namespace porosph {

/// The flow is computed once, in the soil as it is drawn, or given.
class SteadyWater final : public FlowingWater {
 public:
  /// Throws std::runtime_error as solve_steady() does, and where a part of the soil has no face with a head.
  SteadyWater(const Case& scene, const Particles& particles, const Vec2& origin = Vec2::Zero());

  void visit(StateArchive&) override {}
};

}  // namespace porosph
