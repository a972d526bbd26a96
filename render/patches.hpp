// Coloured cells on a picture.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/canvas.hpp"

namespace porosph::render {

/// Polygons of one colour each, in pixels from the lower left corner of `area`, outside of which nothing is
/// drawn.
struct Patches {
  Box area;
  double dot = 0;  ///< above 0: all patches have one corner and are squares of this side about it [pixels]
  std::vector<Pixel> corners;
  std::vector<std::size_t> ends;  ///< of each patch: number of corners up to its last one
  std::vector<Colour> colours;

  std::size_t size() const { return ends.size(); }
  std::span<const Pixel> patch(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return {corners.data() + begin, ends[i] - begin};
  }
  void add(std::span<const Pixel> polygon, const Colour& colour) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    ends.push_back(corners.size());
    colours.push_back(colour);
  }
};

/// The same on a picture of lines: few large regions, each filled by the even-odd rule over the one before.
struct FilledRegion {
  std::vector<std::vector<Pixel>> rings;
  Colour colour;
};

}  // namespace porosph::render
