// Values that are allowed but can hardly be meant: wrong units, soil that floats or cannot carry itself.
#pragma once

#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// One warning for each value of the case that looks wrong: key, value, what follows from it, and the value
/// that was likely meant. Needs sound outlines.
std::vector<std::string> doubtful_values(const Case& scene);

/// What the soils' own weight does, by one-dimensional compression along vertical lines (buoyant below
/// water). Unit weights that look like kN/m3 or kg/m3 are taken as such.
struct Settlement {
  std::size_t soil = 0;    ///< that is compressed most
  double compression = 0;  ///< of it, settlement over thickness along the worst line [-]
};
Settlement settlement_by_own_weight(const Case& scene);

/// What a breakdown of this case most likely comes from, as the end of a sentence: soil too soft for its
/// weight, or else the first of known_failures(), or else what remains.
std::string usual_cause_of_breakdown(const Case& scene);

/// Area of a soil, holes taken off, and its part below the water level [m2].
struct SoilArea {
  double whole = 0, wet = 0;
};
SoilArea area_of(const SoilCase& soil, const WaterCase& water);

/// How thick a soil is, also where it is bent: the least width of its hull, or the width of the strip that
/// has its area and circumference [m].
double typical_thickness(const SoilCase& soil);

}  // namespace porosph
