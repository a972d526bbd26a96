#include "app/picture_options.hpp"

#include <fmt/format.h>

#include "app/command.hpp"
#include "render/drawing.hpp"

namespace porosph::app {

using namespace render;

FieldStyle read_style(const std::string& text) {
  if (text == "particles") return FieldStyle::particles;
  if (text == "bands") return FieldStyle::bands;
  if (text == "isolines") return FieldStyle::isolines;
  throw UsageError(fmt::format("--style = {}: must be particles, bands or isolines", text));
}

void require_picture_name(const std::filesystem::path& path) {
  if (!is_picture_file(path))
    throw UsageError(fmt::format("--out = {}: the name must end in .png, .svg or .pdf", path.string()));
}

}  // namespace porosph::app
