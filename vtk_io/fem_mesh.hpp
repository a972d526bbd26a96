// Triangles for the finite-element reference of any case, by VTK's constrained Delaunay triangulation.
#pragma once

#include "solver/reference/fem/mesh.hpp"

namespace porosph {

/// Edges about h [m] long that follow outlines, soil interfaces, water levels and stretch ends, finer towards
/// corners (see mesh_size()). Throws std::runtime_error if h <= 0, soils overlap, or the triangles do not
/// fill the soils or do not follow the lines.
Mesh mesh_case(const Case&, double h);

}  // namespace porosph
