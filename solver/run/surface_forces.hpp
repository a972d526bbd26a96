// What acts on the soil's surface: loads, footings and sheets.
#pragma once

#include <span>
#include <vector>

#include "solver/run/footings.hpp"
#include "solver/run/sheets.hpp"
#include "solver/run/surface_loads.hpp"

namespace porosph {

struct SurfaceForces {
  std::vector<LoadedParticles> loads;
  std::vector<Footing> footings;
  std::vector<Sheet> sheets;

  /// Whether anything holds the soil, so that a step's forces depend on its length.
  bool hold_soil() const { return !footings.empty() || !sheets.empty(); }

  /// Adds what all loads do at a time [s] to the accelerations [m/s2], the model's own among them.
  void press(const Model& model, double time, std::span<Vec2> accelerations) const;
  /// Adds what footings and sheets do: see Footing::hold and Sheet::hold.
  void hold(const Model& model, Kick kick, double dt, double then, std::span<Vec2> accelerations);
  /// Sum of the squares of the forces on the particles [N2/m2].
  double squares(double time) const;
};

/// Of a case. Throws as surface_loads, make_footings and make_sheets, and where a footing and a sheet hold
/// the same particle.
SurfaceForces surface_forces(const Case& scene, const Model& model);

}  // namespace porosph
