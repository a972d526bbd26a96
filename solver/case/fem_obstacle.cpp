#include "solver/case/fem_obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/case/case_file.hpp"
#include "solver/case/check_boundaries.hpp"

namespace porosph {

std::string fem_obstacle(const Case& scene) {
  if (!scene.stages.empty() || scene.plan) return "the case has stages";
  if (!scene.start_from.empty()) return "the case starts from the state of another run";
  if (scene.loading.horizontal != 0) return "gravity is not upright (loading.horizontal)";
  for (const SoilCase& soil : scene.soils) {
    if (soil.no_tension) return fmt::format("soil '{}' carries no tension, which is not linear", soil.name);
    if (soil.law != LawKind::elastic)
      return fmt::format("soil '{}' yields (law = \"{}\"), which is not linear", soil.name,
                         law_name(soil.law));
    if (soil.velocity != Point::Zero() || soil.angular_velocity != 0 || soil.bending_velocity != 0)
      return fmt::format("soil '{}' has an initial velocity", soil.name);
  }
  if (std::ranges::count(falling_soils(scene), true) > 0) return "a body falls";
  for (const BoundaryCase& b : scene.boundaries)
    if (b.kind == BoundaryKind::friction)
      return "soil slides along a wall against friction, which is not linear";
    else if (b.kind == BoundaryKind::periodic)
      return "sides are periodic";
  if (scene.shaking.acts()) return "the base shakes";
  if (!scene.footings.empty()) return "there are footings";
  if (!scene.sheets.empty()) return "there are sheets";
  if (!scene.loading.gravity_applied && scene.loads.empty())
    return "the scene is weightless, and has no load";
  if (scene.loading.k0_stress) return "the soil starts from the K0 stress";
  if (!scene.water.level_over_time.empty() || scene.water.flows_over_time()) return "the water moves";
  for (const SoilCase& soil : scene.soils)
    if (soil.permeability_law != PermeabilityLaw::constant)
      return fmt::format("the permeability of soil '{}' follows its pores, which is not linear", soil.name);
  if (!scene.water.drains.empty()) return "there are drains in the soil";
  const auto rains = [](const HydraulicFaceCase& f) { return f.kind == FaceKind::rain; };
  if (std::ranges::any_of(scene.water.faces, rains)) return "rain runs off";
  const auto tabulated = [](const SoilCase& s) { return s.retention.model == RetentionModel::table; };
  if (std::ranges::any_of(scene.soils, tabulated)) return "a soil's retention is a table";
  return "";
}

}  // namespace porosph
