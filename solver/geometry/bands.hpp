// Rows and columns of cells that have their middle on free surfaces and end at walls.
#pragma once

#include <vector>

#include "solver/geometry/region.hpp"

namespace porosph {

/// Where the cells of one row or column have their middle and their ends [m].
struct Band {
  double middle = 0, low = 0, high = 0;
  double width = 0;  ///< high - low, to the last bit the same for bands that are equally wide
};

/// Where bands have the free surfaces that lie along them.
enum class FreeSurfaces {
  in_the_middle,  ///< of a band
  at_ends,        ///< between bands, as walls
};

/// Columns (axis 0) or rows (axis 1) over all regions, as wide as the case's spacing up to what makes whole
/// bands fit between the straight stretches of outlines along them: n between two walls or borders of soils,
/// n between two free surfaces (both in the middle of a band), n + 1/2 between a wall and a free surface.
/// Where such a free surface ends (a toe, a crest) there is the middle of a band too, unless it is near
/// another line. Bands end at sheets, and where these end. With FreeSurfaces::at_ends free surfaces are as
/// walls: n bands between any two stretches.
std::vector<Band> bands_along(int axis, const Case& scene, const std::vector<Region>& regions,
                              FreeSurfaces free_surfaces);

}  // namespace porosph
