#include "solver/run/surface_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solver/boundary/load.hpp"

namespace porosph {

void SurfaceForces::press(const Model& model, double time, std::span<Vec2> accelerations) const {
  add_loads(model.loads, model.particles, time, accelerations);
  add_surface_loads(loads, model.particles, time, accelerations);
}

void SurfaceForces::hold(const Model& model, Kick kick, double dt, double then,
                         std::span<Vec2> accelerations) {
  for (Footing& footing : footings) footing.hold(model.particles, kick, dt, then, accelerations);
  for (Sheet& sheet : sheets) sheet.hold(model, kick, dt, accelerations);
}

double SurfaceForces::squares(double time) const {
  double sum = load_squares(loads, time);
  for (const Footing& footing : footings) sum += footing.squares();
  for (const Sheet& sheet : sheets) sum += sheet.squares();
  return sum;
}

SurfaceForces surface_forces(const Case& scene, const Model& model) {
  SurfaceForces forces{surface_loads(scene, model), make_footings(scene, model), make_sheets(scene, model)};
  for (const Footing& footing : forces.footings)
    for (const Sheet& sheet : forces.sheets)
      if (std::ranges::find_first_of(footing.particles(), sheet.particles()) != footing.particles().end())
        throw std::runtime_error(
            fmt::format("footing '{}' holds a particle that sheet '{}' holds: they must be further apart",
                        footing.name(), sheet.name()));
  return forces;
}

}  // namespace porosph
