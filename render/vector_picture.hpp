// Drawings as files of lines and glyphs.
#pragma once

#include <string>

#include "render/drawing.hpp"

namespace porosph::render {

/// The files' contents. Text is drawn as outlines of DejaVu Sans, so that it looks the same everywhere.
std::string svg_of(const Drawing& drawing);
std::string pdf_of(const Drawing& drawing);

}  // namespace porosph::render
