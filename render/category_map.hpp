// A map of outcomes: one cell per pair of settings, coloured by class, with a word or a number in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/canvas.hpp"

namespace porosph::render {

struct MapCategory {
  std::string label;  ///< in the legend
  Colour colour;
};

struct MapCell {
  int category = -1;             ///< index into CategoryMap::categories; -1: left empty
  std::string text, small_text;  ///< in the cell: a number, and a line below it
};

struct MapAxis {
  std::string title;
  std::vector<std::string> labels;  ///< of its places; at least one
  std::vector<bool> usual;          ///< places to be marked; empty: none
};

struct CategoryMap {
  std::string title;
  MapAxis x, y;  ///< x to the right, y upwards
  std::vector<MapCategory> categories;
  std::vector<MapCell> cells;      ///< x runs fastest
  std::vector<std::string> notes;  ///< below the map
  std::string mark_label;          ///< in the legend, what the marked places are
};

/// Draws the map as PNG, SVG or PDF, by the extension, as large as its labels need. Same map, same bytes.
/// Throws std::runtime_error for cells that do not fit the axes, a picture that would be too large, or a file
/// that cannot be written.
void save_category_map(const CategoryMap& map, const std::filesystem::path& path);

}  // namespace porosph::render
