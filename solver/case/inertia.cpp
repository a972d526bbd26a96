#include "solver/case/inertia.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/case/case_file.hpp"
#include "solver/case/check_boundaries.hpp"
#include "solver/soil/elasticity.hpp"

namespace porosph {
namespace {

constexpr double enough = 4;  ///< ratio of M / rho from which "auto" scales inertia: docs/theory.md

std::string obstacle_of_soil(const SoilCase& soil) {
  if (soil.law != LawKind::elastic)
    return fmt::format("soil '{}' yields (law = \"{}\")", soil.name, law_name(soil.law));
  if (soil.no_tension) return fmt::format("soil '{}' carries no tension", soil.name);
  if (soil.velocity != Point::Zero() || soil.angular_velocity != 0 || soil.bending_velocity != 0)
    return fmt::format("soil '{}' has an initial velocity", soil.name);
  return "";
}

std::string obstacle_of_surface(const Case& scene) {
  if (!scene.footings.empty()) return "there are footings";
  if (!scene.sheets.empty()) return "there are sheets";
  if (std::ranges::any_of(scene.loads, [](const LoadCase& load) { return !load.over_time.empty(); }))
    return "a load changes over time";
  if (std::ranges::count(scene.boundaries, BoundaryKind::friction, &BoundaryCase::kind) > 0)
    return "soil slides along a wall against friction";
  return "";
}

}  // namespace

double modulus_over_density(const SoilCase& soil, double gravity) {
  const double weight = std::min(soil.unit_weight_saturated, soil.unit_weight_unsaturated);
  if (!(weight > 0)) return 0;
  return Elasticity::from_young(soil.youngs_modulus, soil.poissons_ratio).constrained_modulus() * gravity /
         weight;
}

std::string inertia_obstacle(const Case& scene) {
  if (!scene.loading.adaptive_damping || scene.loading.damping_until < never)
    return "it is for loading.damping = \"adaptive\" until the end";
  if (scene.formulation.motion != Motion::consistent) return "it is for formulation.motion = \"consistent\"";
  for (const SoilCase& soil : scene.soils)
    if (const std::string reason = obstacle_of_soil(soil); !reason.empty()) return reason;
  if (const std::string reason = obstacle_of_surface(scene); !reason.empty()) return reason;
  if (scene.water.flows_over_time() || !scene.water.level_over_time.empty()) return "the water moves";
  if (std::ranges::count(falling_soils(scene), true) > 0) return "a body falls";
  return "";
}

std::vector<double> inertia_over_mass(const Case& scene) {
  std::vector<double> inertia(scene.soils.size(), 1);
  if (!scene.loading.scaled_inertia_auto && !scene.loading.scaled_inertia) return inertia;
  std::vector<double> squares;
  for (const SoilCase& soil : scene.soils)
    squares.push_back(modulus_over_density(soil, scene.loading.gravity));
  if (squares.empty()) return inertia;
  const auto [slowest, fastest] = std::ranges::minmax(squares);
  const double least = scene.loading.scaled_inertia_auto ? enough : 1;
  if (!(slowest > 0) || fastest <= least * slowest || !inertia_obstacle(scene).empty()) return inertia;
  for (std::size_t i = 0; i < squares.size(); ++i) inertia[i] = squares[i] / slowest;
  return inertia;
}

}  // namespace porosph
