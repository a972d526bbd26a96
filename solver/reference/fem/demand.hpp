// What a finite-element solution will take to compute, told before it is.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

struct FemDemand {
  double triangles = 0;
  double unknowns = 0;
  double bytes = 0;    ///< of memory
  double seconds = 0;  ///< of one core, within a factor of two or so
};

/// With edges of h [m] far from corners (mesh_case). The mesh's points are counted, unless the areas alone
/// tell that there are more than most_fem_unknowns: then it is a lower bound. Throws std::runtime_error if h
/// is not positive, or longer than the section, or soils overlap.
FemDemand fem_demand(const Case&, double h);

/// The edge that makes about `triangles` triangles before those that corners add [m].
double fem_edge(const Case&, double triangles);

/// Beyond these the factors' indices, 32 bits wide, would overflow.
inline constexpr double most_fem_unknowns = 1e7;

/// Throws std::runtime_error, naming unknowns and memory, if they are more than these bytes or indices allow.
void check_fem_demand(const FemDemand&, double bytes);

}  // namespace porosph
