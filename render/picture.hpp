// Drawings as pixels.
#pragma once

#include <string>

#include "render/drawing.hpp"
#include "render/film.hpp"

namespace porosph::render {

/// More patches than this are drawn as square GL points of a whole number of device pixels, which is faster.
inline constexpr std::size_t most_quads = 500'000;

/// The contents of a PNG file, or the pixels themselves. Drawn at twice the size and averaged, which smooths
/// text, lines and fields alike. The caller holds render_mutex().
std::string png_of(const Drawing& drawing);
Pixels pixels_of(const Drawing& drawing);

}  // namespace porosph::render
