// The slip surface with the least factor of safety.
#pragma once

#include <optional>

#include "solver/reference/limit_equilibrium/section.hpp"
#include "solver/reference/limit_equilibrium/slices.hpp"

namespace porosph::limit_equilibrium {

struct CriticalSurface {
  double factor = 0;   ///< of safety
  SlipSurface points;  ///< from left to right [m]
};

struct CriticalSurfaces {
  CriticalSurface bishop;  ///< least among circles by Bishop's simplified method
  std::optional<CriticalSurface>
      spencer;  ///< least among circles by Spencer's method, where it has solutions
  /// Least among surfaces of any shape by Spencer's method, where soils of different strength meet. In one
  /// soil it is not sought: without friction it would come out too low by up to 7 %, as a body that does not
  /// slide on a circle has to shear inside, which the method leaves out.
  std::optional<CriticalSurface> general;
};

/// Searches circles between all parts of the ground, on slopes that face left and right, then bends the worst
/// of them, and those cut off at the bottom of each soil, into other shapes that are convex downwards.
/// Nothing where nothing can slide: level ground, or no soil with a strength.
std::optional<CriticalSurfaces> find_critical_surfaces(const Section& section);

}  // namespace porosph::limit_equilibrium
