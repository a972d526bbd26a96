// The slices above a slip surface.
#pragma once

#include <vector>

#include "solver/reference/limit_equilibrium/section.hpp"

namespace porosph::limit_equilibrium {

/// From where the surface leaves the ground, on the left, to where it enters it; soil above it slides to the
/// left. x increases.
using SlipSurface = std::vector<Point>;

/// A slice, its forces per metre of thickness. Water and loads on its top, and what accelerates it sideways,
/// press with (push, -press) [N/m].
struct Slice {
  Point base;            ///< middle of its base [m]
  double width, length;  ///< of the base, horizontally and along it [m]
  double sine, cosine;   ///< of the base's slope, positive where it rises to the right
  double weight;         ///< [N/m]
  double push, press;    ///< beside its weight, to the right and downwards [N/m]
  double torque;         ///< of that about (0, 0), counter-clockwise [N]
  double pore_pressure;  ///< u at the middle of the base [Pa]
  Strength strength;     ///< there
};

/// Cuts what is above the surface into slices where the surface, the section or the soil at the base has a
/// corner. Empty where the surface is not inside the section's soil: above the ground or below the floor.
void cut(const Section& section, const SlipSurface& surface, std::vector<Slice>& slices);

}  // namespace porosph::limit_equilibrium
