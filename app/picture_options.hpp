// Options that several commands have for their pictures.
#pragma once

#include <filesystem>
#include <string>

#include "render/contour.hpp"

namespace porosph::app {

/// Of --style. Throws UsageError for another word than particles, bands or isolines.
render::FieldStyle read_style(const std::string& text);

/// Throws UsageError unless a picture can be written to this name given by --out.
void require_picture_name(const std::filesystem::path& path);

}  // namespace porosph::app
