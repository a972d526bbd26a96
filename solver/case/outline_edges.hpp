// The straight edges of the soils' outlines, and which of them are free surfaces.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

struct OutlineEdge {
  Point a, b;            ///< [m]
  std::size_t soil = 0;  ///< whose outline it is on
};

/// One list of rings (outline, then holes) for each soil; the edges in the order of the rings.
std::vector<OutlineEdge> outline_edges(const std::vector<std::vector<Polygon>>& rings_of_soils);
std::vector<OutlineEdge> outline_edges(const std::vector<SoilCase>& soils);

/// Whether neither a wall nor the outline of another soil covers any part of the edge. tolerance: distance up
/// to which two lines are one [m].
bool is_free(const OutlineEdge& edge, const std::vector<OutlineEdge>& edges,
             const std::vector<BoundaryCase>& walls, double tolerance);

/// What Arrangement::automatic stands for: `surface` where all edges lie along the axes and those that are
/// free are level, `stretched` elsewhere. (Measured for docs/theory.md, "Outlines".)
Arrangement arrangement_for(const Case& scene);

}  // namespace porosph
