// Which stretch of the outline, as water sees it, the edges of a mesh lie on.
#pragma once

#include "solver/reference/fem/p4_mesh.hpp"
#include "solver/water/flow/outline.hpp"

namespace porosph {

/// The stretch nearest to a point, such as the middle of an edge.
int stretch_beside(const HydraulicOutline& outline, const Point& place);

/// Index of the case's face there; -1 where none is named.
int face_at(const HydraulicOutline& outline, const Point& place);

/// [m]
double shortest_outline_edge(const Mesh&, const P4Mesh&);

}  // namespace porosph
