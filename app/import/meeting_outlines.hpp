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

bool is_inside(const Point& p, const Polygon& outline);

/// Moves corners of lines that are nearer than `snap` to each other to one place, and gives lines the ends of
/// others that lie on them. Closed lines repeat their first point. Returns how far corners were moved [m].
double make_lines_meet(std::vector<Polygon>& lines, double snap);

/// Moves corners that are nearer than `snap` to each other to one place, gives edges the corners of others
/// that lie on them, removes regions drawn twice or without area, and makes a region that lies inside another
/// a hole of the smallest around it. Outlines come out counter-clockwise. Returns what was changed or
/// removed, for people. Throws
/// DrawingError where a region surrounds others that touch and has no hole around them.
std::vector<std::string> make_outlines_meet(std::vector<Region>& regions, double snap);

}  // namespace porosph::drawn
