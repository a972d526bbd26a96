// What the colours of a contour picture mean.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "render/axes.hpp"
#include "render/colour_map.hpp"
#include "render/colour_range.hpp"

namespace porosph::render {

struct ColourScale {
  std::string label;  ///< quantity with its unit, e.g. "σ'yy [kPa]"
  ColourMap map = ColourMap::viridis;
  std::optional<ValueRange> range =
      {};  ///< default: the extent of the values, rounded; centred at zero if diverging
  std::vector<std::string> categories = {};  ///< names of the values 0, 1, ...: the bar has a box for each
  bool bands = false;                        ///< a colour per step of the bar, in place of continuous ones
  bool logarithmic = false;  ///< where the range is positive; zero and less have the colour of the low end
};

/// A scale whose range is known, and what the values shown with it do.
struct FixedScale {
  std::string label;
  ColourMap map = ColourMap::viridis;
  ValueRange range;
  bool values_below = false, values_above = false, values_invalid = false;
  ValueRange extent = {};  ///< of the values
  std::vector<std::string> categories = {};
  std::vector<double> levels = {};  ///< within the range, increasing: where isolines are, and colours change
  bool bands = false;
  bool logarithmic = false;
};

/// Settles the range for all of `values`. Throws std::runtime_error for a given range that is empty or not
/// finite.
FixedScale fix_scale(const ColourScale& scale, std::span<const double> values);

/// Colour of each value: outside of the range that of its end, not finite the map's invalid colour. A
/// sequential map whose range holds zero continues in reds above it.
std::vector<Colour> colours_of(std::span<const double> values, const FixedScale& scale);

/// The colour of each band between the levels, below the first one first.
std::vector<Colour> band_colours(const FixedScale& scale);

/// Width of bar, labels and title together, for a bar of this height [pixels].
double colour_bar_width(const FixedScale& scale, double height);

/// `box`: left edge, and the heights that the bar spans; the width is colour_bar_width's.
/// Pointed ends say that values go beyond the range, and how far; a swatch below the bar explains the invalid
/// colour.
void draw_colour_bar(Canvas& canvas, const Box& box, const FixedScale& scale);

}  // namespace porosph::render
