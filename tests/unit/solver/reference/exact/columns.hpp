// The paper's foundation as a column, and what tests vary of it.
#pragma once

#include "solver/reference/exact/column.hpp"

namespace porosph {

/// E = 15 MPa, nu = 0.33, 10 m high, water level 5 m above the ground.
inline Column foundation() {
  const double e = 15e6, nu = 0.33;
  Column column;
  column.height = 10;
  column.bulk_modulus = e / (3 * (1 - 2 * nu));
  column.shear_modulus = e / (2 * (1 + nu));
  column.unit_weight_saturated = 20e3;
  column.unit_weight_unsaturated = 18.6e3;
  column.unit_weight_water = 9810;
  column.water_level = 15;
  return column;
}

/// Soft enough for strains of several per cent.
inline Column soft_foundation() {
  Column column = foundation();
  column.bulk_modulus /= 20;
  column.shear_modulus /= 20;
  return column;
}

}  // namespace porosph
