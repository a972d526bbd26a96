// What saturated soil's water flows by, and what keeps its pressure from alternating.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/water/flow/pressure_stabilisation.hpp"

namespace porosph {

/// The flow of excess heads, which are measured from the level of the water that stands.
struct Drainage {
  HydraulicOutline outline;
  FaceConditions faces;
  DarcyFlow flow;
  std::vector<std::int32_t> pinned = {};  ///< patch of particles that lie on a face, or -1
};

/// As the case is drawn; nothing but in coupled soil.
std::optional<Drainage> drainage(const Case& scene, const Particles& particles);

/// Heads count as below all levels: kr = 1. Of the particles where they are in `particles`.
DarcyFlow saturated_flow(const std::vector<SoilCase>& soils, const HydraulicOutline& outline,
                         const Particles& particles, double spacing);

/// With these permeabilities, one for each soil, as tau.
PressureStabilisation pressure_stabilisation(const Case& scene, std::span<const double> tau,
                                             const Particles& particles);

/// S of each particle: what its water gives by its own compression, per head [m].
std::vector<double> storage_of_water(const Case& scene, const Particles& particles);

}  // namespace porosph
