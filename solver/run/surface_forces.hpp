// What acts on the soil's surface: loads and footings.
#pragma once

#include <span>
#include <vector>

#include "solver/run/footings.hpp"
#include "solver/run/surface_loads.hpp"

namespace porosph {

struct SurfaceForces {
  std::vector<LoadedParticles> loads;
  std::vector<Footing> footings;

  /// Adds what all loads do at a time [s] to the accelerations [m/s2], the model's own among them.
  void press(const Model& model, double time, std::span<Vec2> accelerations) const;
  /// Adds what the footings do: see Footing::hold.
  void hold(const Particles& particles, Kick kick, double dt, double then, std::span<Vec2> accelerations);
  /// Sum of the squares of the forces on the particles [N2/m2].
  double squares(double time) const;
};

/// Of a case. Throws as surface_loads and make_footings.
SurfaceForces surface_forces(const Case& scene, const Model& model);

}  // namespace porosph
