// Outlines that were drawn by hand, made to meet exactly.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph::drawn {

/// An outline and its holes, with a name.
struct Region {
  std::string name;
  std::vector<Polygon> rings;
};

/// Moves corners that are nearer than `snap` to each other to one place, gives edges the corners of others
/// that lie on them, removes regions drawn twice or without area, and makes a region that lies inside another
/// a hole of the smallest around it. Outlines come out counter-clockwise. Returns what was changed or
/// removed, for people. Throws
/// DrawingError where a region surrounds others that touch.
std::vector<std::string> make_outlines_meet(std::vector<Region>& regions, double snap);

}  // namespace porosph::drawn
