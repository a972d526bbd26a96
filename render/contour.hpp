// Contour pictures of particle data: one or several panels, drawn to the same scale of length.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/colour_bar.hpp"
#include "render/scenery.hpp"
#include "solver/space/tensor.hpp"

namespace porosph::render {

/// One scalar on particles, each a square of side `sizes` or its cell, at position + factor * displacement.
struct ParticleField {
  std::vector<Point> positions;  ///< [m]
  std::vector<double> values;  ///< one per particle, in the unit of the colour scale; not finite: drawn grey
  std::vector<double> sizes;   ///< dx, one for all or one per particle [m]
  std::vector<Polygon> cells;  ///< none, or one per particle, about its position; empty ones: squares [m]
  std::vector<Point> displacements;  ///< none, or one per particle [m]
  double displacement_factor = 1;
};

/// The same scalar on triangles, linear in each.
struct SmoothField {
  std::vector<Point> points;   ///< [m]; the first ones are the particles'
  std::vector<double> values;  ///< one per point, in the unit of the colour scale
  std::vector<std::array<int, 3>> triangles;
  std::vector<bool> uncovered;  ///< particles around which triangles are missing: these are drawn beneath
};

/// How a field is drawn.
enum class FieldStyle {
  particles,  ///< each particle in its colour
  bands,      ///< bands between levels, with labelled isolines
  isolines,   ///< each particle in its colour, with labelled isolines
};

struct ContourPanel {
  std::string title, subtitle;  ///< e.g. the formulation, and the time
  ParticleField particles;
  std::optional<SmoothField> smooth;  ///< for the styles bands and isolines
  std::vector<Point> arrows;  ///< a vector per particle, or none; some are drawn, the longest one a cell long
  std::vector<Stress> crosses;      ///< a stress per particle, or none: principal directions, likewise
  std::vector<SoilOutline> before;  ///< outlines that are drawn dashed [m]
  Scenery scenery;
  std::optional<ColourScale> own_scale;  ///< default: the figure's, shared with its range by all such panels
};

struct ContourFigure {
  std::string title;  ///< may be empty
  std::vector<ContourPanel> panels;
  ColourScale scale;
  FieldStyle style = FieldStyle::particles;
  std::vector<Point> include = {};  ///< places that must be in each panel [m]
  int columns = 0;                  ///< 0: as fits the bodies' shape best
  int width = 0, height = 0;        ///< [pixels]; 0: fitted to the content, at most 1600 x 1200
};

/// Two corners of what a picture of the panel shows of soil and particles, without what was thrown off [m].
std::array<Point, 2> shown_box(const ContourPanel& panel);

/// Draws the figure as PNG, SVG or PDF, by the extension. Same figure, same bytes. May be called from any
/// thread. Throws std::runtime_error for arrays of unequal length, a panel without particles, an empty range,
/// a picture that is too small for its panels, a missing font or a file that cannot be written.
void save_contours(const ContourFigure& figure, const std::filesystem::path& path);

/// Draws each panel as a picture of its own, one file each, with the range of colours and the places of the
/// whole figure; `width` [pixels], as high as it needs to be. Throws as save_contours.
void save_each_panel(const ContourFigure& figure, int width, const std::vector<std::filesystem::path>& paths);

/// Draws figures one after the other into an animated WebP. All have the size of the last one, or the one
/// they ask for. Throws as save_contours, and for figures that do not fit that size.
void save_film(std::size_t count, const std::function<ContourFigure(std::size_t)>& figure,
               double pictures_per_second, const std::filesystem::path& path);

}  // namespace porosph::render
