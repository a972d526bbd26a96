// Bands and isolines of a field that is linear on triangles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/canvas.hpp"

namespace porosph::render {

/// Triangles over points of the picture, with a value at each point. Triangles with a value that is not
/// finite are left out of all that follows.
struct TriangleField {
  std::vector<Pixel> points;
  std::vector<double> values;  ///< one per point
  std::vector<std::array<int, 3>> triangles;
};

/// A convex piece of a triangle within one band.
struct BandPiece {
  std::array<Pixel, 5> corners;
  int count = 0;
  int band = 0;  ///< 0 below the first level, as many as there are levels above the last one
};

/// All triangles, cut along the levels, which increase.
std::vector<BandPiece> band_pieces(const TriangleField& field, std::span<const double> levels);

/// The lines on which the field has the level: closed, or from border to border.
std::vector<std::vector<Pixel>> isolines(const TriangleField& field, double level);

/// Closed outlines of all that lies at or above the level; filled by the even-odd rule they are that region.
/// Minus infinity gives the whole field.
std::vector<std::vector<Pixel>> region_above(const TriangleField& field, double level);

}  // namespace porosph::render
