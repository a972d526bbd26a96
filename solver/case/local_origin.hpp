// Coordinates far from zero, as of maps (4512345.25 m), and the origin near the soil that is computed with.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

/// What to subtract from all coordinates so that no digits are lost: zero where the soils lie within 10 km of
/// the case's own origin, else the whole metres below and left of them [m]. By axis.
Point local_origin(const Case& scene);

/// The same case, moved: soils, water, boundaries, loads and probes [m].
Case moved(Case scene, const Point& by);

}  // namespace porosph
