// A soil column between smooth walls on a fixed bottom, under its own weight and still water.
#pragma once

#include "solver/case/case.hpp"

namespace porosph {

/// Heights are measured from the column's fixed bottom. Stress is effective, tension positive.
struct Column {
  double height = 0;                 ///< H, before loading [m]
  double bulk_modulus = 0;           ///< K [Pa]
  double shear_modulus = 0;          ///< G [Pa]
  double unit_weight_saturated = 0;  ///< gamma_sat, of what lies below the water level before loading [N/m3]
  double unit_weight_unsaturated =
      0;                         ///< gamma_unsat, of what lies above it; not used if there is none [N/m3]
  double unit_weight_water = 0;  ///< gamma_w; not used if there is no water [N/m3]
  double water_level = -never;   ///< above the bottom; negative: no water [m]

  double constrained_modulus() const { return bulk_modulus + 4 * shear_modulus / 3; }  ///< M [Pa]
  double lame_lambda() const { return bulk_modulus - 2 * shear_modulus / 3; }          ///< lambda [Pa]
};

/// Throws std::invalid_argument, naming what is wrong, unless height, moduli and the unit weights in use are
/// positive and the soil is heavier than the water in it.
void check(const Column& column);

/// The textbook's vertical effective stress at a height, for strains that change nothing [Pa]:
/// -gamma_unsat * depth above the water, and gamma_sat - gamma_w per depth below it.
double textbook_vertical_stress(const Column& column, double height);

}  // namespace porosph
