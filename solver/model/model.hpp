// A case made ready to compute: particles, soils, water and walls.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/boundary/load.hpp"
#include "solver/boundary/visibility.hpp"
#include "solver/boundary/wall.hpp"
#include "solver/case/case.hpp"
#include "solver/particles/particles.hpp"
#include "solver/soil/soil.hpp"
#include "solver/water/pore_water.hpp"

namespace porosph {

/// What sets off motion that alternates from particle to particle, which a spring then holds.
enum class Press : std::uint8_t {
  none,
  on_soil,            ///< footings, or loads on a stepped lattice
  on_soil_and_water,  ///< footings or loads on soil at rest whose water is coupled or undrained
};

struct Model {
  Particles particles;
  std::vector<Soil> soils;
  StandingWater water;                    ///< outside the soil
  std::shared_ptr<PoreWater> pore_water;  ///< in it; copies of the model share it
  std::vector<LoadedSurface> loads;
  Press press = Press::none;
  std::vector<Wall> walls;
  Visibility visibility;         ///< who sees whom past outlines
  double spacing = 0;            ///< dx [m]
  double smoothing_length = 0;   ///< h [m]
  Vec2 gravity = Vec2::Zero();   ///< [m/s2]
  double wave_speed = 0;         ///< fastest c_p = sqrt(M / rho) of all soils, water not moving along, with
                                 ///< inertia_over_mass() [m/s]
  Point origin = Point::Zero();  ///< what all positions here are relative to, in the case's coordinates [m]
  std::string usual_cause;       ///< what a breakdown of this case most likely comes from
};

/// Places the particles and gives them mass, initial stress (zero or K0) and pore pressure. Far from the
/// case's origin, positions are relative to local_origin().
/// Throws std::runtime_error where a soil holds no particle or a boundary touches none.
Model build_model(const Case& case_as_drawn);

/// K0 stress of a particle: the weight of the soil and water above it, along a vertical line (effective)
/// [Pa].
Stress k0_stress(const Case& scene, const Point& position, double k0);

}  // namespace porosph
