// Points of a section where stress is unbounded or lacks derivatives.
#pragma once

#include <vector>

#include "solver/reference/fem/mesh_lines.hpp"

namespace porosph {

struct RoughPoint {
  enum Kind {
    weak,              ///< stress lacks derivatives: a crest, the end of a water level
    interface_corner,  ///< where the line between two soils turns or branches inside
    singular,          ///< stress is unbounded: a toe, the end of a fixed part or of an interface
  };
  Point at;
  Kind kind;
  double shortest;  ///< of the lines that meet there [m]
  double angle;     ///< of the soil where two lines of the outline meet, else 0 [rad]
  bool on_rollers;  ///< all lines of the outline that meet there are rollers
};

/// Corners of the outline where free parts meet, where the way that the outline is held changes, and where a
/// soil interface or a water level ends on it other than at a roller (where it is taken to be level and so
/// regular): Williams 1952, J. Appl. Mech. 19. Besides, corners of interfaces.
std::vector<RoughPoint> rough_points(const Case&, const MeshLines&);

}  // namespace porosph
