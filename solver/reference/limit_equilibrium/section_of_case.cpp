#include "solver/reference/limit_equilibrium/section_of_case.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/boundary/traction.hpp"
#include "solver/water/standing_water.hpp"

namespace porosph::limit_equilibrium {
namespace {

std::optional<SoilStrength> strength_of(const SoilCase& soil) {
  const StrengthCase& s = soil.strength;
  switch (soil.law) {
    case LawKind::elastic:
      return std::nullopt;
    case LawKind::tresca: {
      if (s.growth == 0) return SoilStrength{s.undrained_strength};
      double top = -never;
      for (const Point& p : soil.polygon) top = std::max(top, p.y());
      return SoilStrength{s.undrained_strength, 0, s.growth, s.level == never ? top : s.level};
    }
    case LawKind::cam_clay: {  // at the critical state, in triaxial compression
      const double sine = 3 * soil.cam_clay.ratio / (6 + soil.cam_clay.ratio),
                   tangent = sine / std::sqrt(1 - sine * sine);
      return SoilStrength{soil.cam_clay.attraction * tangent, tangent};
    }
    case LawKind::drucker_prager:
    case LawKind::mohr_coulomb:
    case LawKind::byrne:
      return SoilStrength{s.cohesion, std::tan(s.friction_angle * std::numbers::pi / 180)};
  }
  return std::nullopt;
}

/// Nothing holds the soil on an upright line.
bool is_free(const Case& scene, double x) {
  const auto on_it = [x](const Point& p) { return std::abs(p.x() - x) < 1e-9 * (1 + std::abs(x)); };
  return std::ranges::none_of(scene.boundaries,
                              [&](const BoundaryCase& b) { return on_it(b.from) && on_it(b.to); });
}

}  // namespace

Section section_of(const Case& scene) {
  std::vector<SectionSoil> soils;
  double left = never, right = -never;
  for (const SoilCase& soil : scene.soils) {
    SectionSoil s{
        {soil.polygon}, soil.unit_weight_saturated, soil.unit_weight_unsaturated, strength_of(soil)};
    s.outlines.insert(s.outlines.end(), soil.holes.begin(), soil.holes.end());
    soils.push_back(std::move(s));
    for (const Point& p : soil.polygon) left = std::min(left, p.x()), right = std::max(right, p.x());
  }
  std::vector<WaterPiece> water;
  for (const WaterStretch& stretch : at_rest_from(scene.water, scene.time.end).stretches) {
    const double from = std::max(stretch.x_from, left - 1), to = std::min(stretch.x_to, right + 1);
    if (from < to) water.push_back({{from, stretch.level}, {to, stretch.level}});
  }
  std::vector<GroundLoad> loads;
  for (const LoadCase& load : scene.loads) {
    const Traction traction(load);
    const Point normal = outward_normal(scene, load.from, load.to);
    loads.push_back({load.from, load.to, traction.traction(load.from, normal, scene.time.end),
                     traction.traction(load.to, normal, scene.time.end)});
  }
  return {std::move(soils), std::move(water),         scene.water.unit_weight,
          std::move(loads), scene.loading.horizontal, {is_free(scene, left), is_free(scene, right)}};
}

}  // namespace porosph::limit_equilibrium
