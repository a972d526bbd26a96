#include "render/font.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace porosph::render {

std::string find_font(const std::string& name, const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    const auto path = std::filesystem::path(directory) / name;
    if (std::filesystem::is_regular_file(path)) return path.string();
  }
  throw std::runtime_error(fmt::format(
      "render: font {} not found in {}; install the package fonts-dejavu-core or set POROSPH_FONT "
      "to a TrueType file",
      name, fmt::join(directories, ", ")));
}

std::string font_file() {
  if (const char* chosen = std::getenv("POROSPH_FONT")) {
    if (std::filesystem::is_regular_file(chosen)) return chosen;
    throw std::runtime_error(fmt::format("render: POROSPH_FONT names {}, which is not a file", chosen));
  }
  return find_font("DejaVuSans.ttf", {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu",
                                      "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF"});
}

}  // namespace porosph::render
