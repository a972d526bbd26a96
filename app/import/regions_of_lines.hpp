// Soils whose outlines were drawn as lines: ground, layers, base and ends, with a text in each region.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/import/drawing.hpp"
#include "app/import/meeting_outlines.hpp"

namespace porosph::drawn {

/// An open line, by the layer that it is on [m].
struct Line {
  std::string layer;
  Polygon points;
};

/// A text at a place [m].
struct Label {
  std::string text, layer;
  Point at = Point::Zero();
};

struct Linework {
  std::vector<Line> lines;
  std::vector<Region> closed;  ///< closed shapes, named by their layers
  std::vector<Label> texts;
  std::vector<Label>
      told;  ///< names that hold in the region around `at`, whatever is drawn there; "": no soil
};

struct NamedRegions {
  std::vector<Region> regions;
  std::vector<std::string> notes;
};

/// What the lines enclose, once points within `snap` are one: each region named as told, by the text in it,
/// or by the smallest closed shape around it. Where the lines enclose nothing beside the closed shapes, these
/// are the regions. Throws DrawingError for a region with several texts or none, for texts outside where
/// lines leave gaps, and for names told outside of all regions; its message names the gaps.
NamedRegions regions_of_lines(const Linework& drawn, double snap, const std::filesystem::path& reader);

}  // namespace porosph::drawn
