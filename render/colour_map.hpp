// Colour maps that do not mislead: even steps of value look like even steps of colour.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace porosph::render {

using Colour = std::array<std::uint8_t, 3>;  ///< sRGB, 0..255

enum class ColourMap {
  viridis,    ///< sequential, dark violet to yellow
  cividis,    ///< sequential, dark blue to yellow, the same to colour-blind readers
  cool_warm,  ///< diverging, blue over light grey to red; for signed fields and differences
};

bool is_diverging(ColourMap map);

/// `count` colours (>= 2) evenly spaced over the map, from its low end to its high end.
std::vector<Colour> colour_table(ColourMap map, int count = 256);

/// `count` colours (>= 2) that continue from the high end of a sequential map to a dark red: for values above
/// zero where those below have the map, so that tension cannot be taken for compression.
std::vector<Colour> above_zero_table(ColourMap map, int count);

/// A grey that the map does not contain, for values that are not finite.
Colour invalid_colour(ColourMap map);

}  // namespace porosph::render
