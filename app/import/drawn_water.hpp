// What drawn water means for a case: still water, or steady flow between the levels that were drawn.
#pragma once

#include "app/import/ground.hpp"

namespace porosph::drawn {

/// The box around all soils [m].
struct Box {
  Point low = Point::Constant(never), high = Point::Constant(-never);
};
Box box_of(const Ground& ground);

/// Adds open water lines, whose ground is known: level stretches, and the levels at which lines reach the
/// ends of the section within the soil. Where a line falls, water flows: a case computes that water table
/// itself, so the fall is left out with a note. Throws DrawingError where it falls above the ground.
void add_water_lines(const std::vector<Polygon>& lines, double snap, Ground& ground);

bool has_water(const Ground& ground);
bool stands_still(const Ground& ground);  ///< one level everywhere

/// The water that stands beside a stretch of the surface, or null.
const WaterLine* water_beside(const Stretch& stretch, const std::vector<WaterLine>& water);

/// The level at which water enters or leaves by a stretch at an end of the section, or null.
const EndLevel* end_level(const Stretch& stretch, const Ground& ground);

/// Throws DrawingError where water flows but touches neither the ground's surface nor an end of the section.
void require_something_drives(const Ground& ground);

}  // namespace porosph::drawn
