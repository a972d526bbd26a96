// Where the particles go.
#pragma once

#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// One particle's place at t = 0.
struct Site {
  Point position = Point::Zero();  ///< [m]
  double area = 0;                 ///< volume per unit thickness [m2]
  int soil = 0;                    ///< index into Case::soils
  double fill = 1;                 ///< part of its cell that is soil: about 1/2 on a free surface
};

/// Fills the soils' polygons with particles, as Case::particles asks (see Arrangement). The same case gives
/// the same sites on every machine. The order is that of the lattice cells the particles belong to, row by
/// row: by y, then by x (exactly so with Arrangement::lattice, nearly so with the others).
///
/// Areas sum up to the area of each soil, whatever the arrangement. Lattice: cell centres inside or on the
/// outline; a centre on the border between two soils goes to the first.
///
/// Throws std::runtime_error, naming the soil, if a polygon is not simple, if soils overlap, or if a soil is
/// so thin that no particle falls into it.
std::vector<Site> place_particles(const Case& scene);

}  // namespace porosph
