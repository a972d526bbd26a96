// The one font of all pictures; VTK's own lacks Greek letters.
#pragma once

#include <string>
#include <vector>

namespace porosph::render {

/// Path of DejaVuSans.ttf, or of the file that the environment variable POROSPH_FONT names.
/// Throws std::runtime_error naming the places searched if there is none: VTK would fall back in silence.
std::string font_file();

/// `directories` searched in turn for `name`; throws as font_file.
std::string find_font(const std::string& name, const std::vector<std::string>& directories);

}  // namespace porosph::render
