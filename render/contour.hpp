// Contour pictures of particle data: one or several panels, drawn to the same scale of length.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/colour_bar.hpp"
#include "render/scenery.hpp"

namespace porosph {

/// One scalar on particles, each a square of side `sizes` or its cell, at position + factor * displacement.
struct ParticleField {
  std::vector<Point> positions;  ///< [m]
  std::vector<double> values;  ///< one per particle, in the unit of the colour scale; not finite: drawn grey
  std::vector<double> sizes;   ///< dx, one for all or one per particle [m]
  std::vector<Polygon> cells;  ///< none, or one per particle, about its position; empty ones: squares [m]
  std::vector<Point> displacements;  ///< none, or one per particle [m]
  double displacement_factor = 1;
};

struct ContourPanel {
  std::string title, subtitle;  ///< e.g. the formulation, and the time
  ParticleField particles;
  Scenery scenery;
  std::optional<ColourScale> own_scale;  ///< default: the figure's, shared with its range by all such panels
};

struct ContourFigure {
  std::string title;  ///< may be empty
  std::vector<ContourPanel> panels;
  ColourScale scale;
  int columns = 0;            ///< 0: as fits the bodies' shape best
  int width = 0, height = 0;  ///< [pixels]; 0: fitted to the content, at most 1600 x 1200
};

/// Draws the figure as PNG. Same figure, same bytes. May be called from any thread.
/// Throws std::runtime_error for arrays of unequal length, a panel without particles, an empty range, a
/// picture that is too small for its panels, a missing font or a file that cannot be written.
void save_contours(const ContourFigure& figure, const std::filesystem::path& path);

}  // namespace porosph
