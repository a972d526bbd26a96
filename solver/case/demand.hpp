// What a case will take to compute, told from its outlines alone, before any memory is taken.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

struct Demand {
  double particles = 0;
  double bytes = 0;  ///< of memory
  double steps = 0;  ///< of time, to the end
};

/// Needs sound outlines and a positive spacing. About right; infinite where numbers overflow.
Demand demand_of(const Case& scene);

inline constexpr double most_particles = 5e7, most_steps = 1e10;

}  // namespace porosph
