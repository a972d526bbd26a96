// A whole picture before it becomes a file: coloured fields below, lines and text on top.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/patches.hpp"

namespace porosph::render {

struct FieldLayer {
  Patches patches;
  /// In files of lines drawn in place of the patches, where it is given.
  std::function<std::vector<FilledRegion>()> regions = {};
};

struct Drawing {
  int width = 0, height = 0;  ///< [pixels], 1 to 8000
  std::string title;          ///< told by files that have a place for it
  std::vector<FieldLayer> layers;
  std::function<void(Canvas&)> paint;  ///< draws what is on top
};

/// Whether pictures can be written with this extension: .png, .svg or .pdf.
bool is_picture_file(const std::filesystem::path& path);

/// Writes PNG, or SVG or PDF, which hold lines and glyphs; chosen by the extension. Same drawing, same bytes.
/// May be called from any thread. Throws std::runtime_error for another extension or a size that cannot be
/// drawn, WriteError.
void save_drawing(const Drawing& drawing, const std::filesystem::path& path);

}  // namespace porosph::render
