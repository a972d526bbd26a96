#include "vtk_io/fem_measure.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "solver/case/case_file.hpp"
#include "solver/case/shapes.hpp"
#include "solver/reference/fem/solve.hpp"
#include "solver/water/standing_water.hpp"
#include "vtk_io/fem_mesh.hpp"

namespace porosph {
namespace {

constexpr double spacings_to_corners = 2.5;

/// The case without what finite elements do not see.
Case seen_by_fem(const Case& scene) {
  Case physics;
  physics.soils = scene.soils;
  physics.water = at_rest_from(scene.water, scene.time.end);
  physics.boundaries = scene.boundaries;
  physics.loading = {.gravity = scene.loading.gravity, .gravity_applied = scene.loading.gravity_applied};
  physics.particles.spacing = scene.water.flows() ? scene.particles.spacing : 1;  // kr falls within one
  physics.time.end = 1;
  return physics;
}

std::shared_ptr<const FemSolution> solution_of(const Case& scene) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const FemSolution>> known;
  const Case physics = seen_by_fem(scene);
  const std::scoped_lock lock(mutex);
  auto& solution = known[write_case(physics)];
  if (!solution) {
    double whole = 0;
    for (const SoilCase& soil : physics.soils) whole += area(soil);
    solution = std::make_shared<FemSolution>(solve_fem(physics, mesh_case(physics, std::sqrt(whole) / 20)));
  }
  return solution;
}

bool near_corner(const Case& scene, const Vec2& x) {
  const double radius = spacings_to_corners * scene.particles.spacing;
  for (const SoilCase& soil : scene.soils)
    for (const Point& corner : soil.polygon)
      if ((x - corner).norm() < radius) return true;
  return false;
}

}  // namespace

ErrorMeasure fem_measure(const Case& scene) {
  return [scene, solution = solution_of(scene)](const Simulation& s) {
    return vertical_stress_error(s, [&](const Vec2& x) {
      return near_corner(scene, x) ? std::nan("") : solution->at(x).effective_stress[1];
    });
  };
}

}  // namespace porosph
