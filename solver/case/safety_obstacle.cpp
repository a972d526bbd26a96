#include "solver/case/safety_obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/case/case_file.hpp"
#include "solver/case/check_boundaries.hpp"

namespace porosph {

std::string safety_obstacle(const Case& scene) {
  if (scene.water.couples())
    return fmt::format(
        "water.mode = \"{}\" is not possible: the factor of safety is that of soil at rest in still or "
        "steady water; give undrained clay the law \"tresca\" in still water",
        name(scene.water.mode));
  if (!scene.loading.gravity_applied)
    return "loading.gravity_applied = false: nothing drives the soil, so it has no factor of safety";
  if (scene.shaking.acts()) return "the base shakes ([shaking]): only soil at rest has a factor of safety";
  if (std::ranges::count(falling_soils(scene), true) > 0)
    return "a body falls, as no boundary carries it: only soil at rest has a factor of safety";
  if (std::ranges::all_of(scene.soils, [](const SoilCase& soil) { return soil.law == LawKind::elastic; }))
    return "no soil of the case has a strength: give one soil[].law = \"mohr_coulomb\", \"drucker_prager\" "
           "or \"tresca\"";
  for (const FootingCase& footing : scene.footings)
    if (footing.settlement < never)
      return fmt::format("footing '{}' is driven by its settlement and cannot fail: give it a force",
                         footing.name);
  return "";
}

std::string limit_equilibrium_obstacle(const Case& scene) {
  if (scene.water.flows())
    return fmt::format("is for still water, but water.mode is \"{}\"", name(scene.water.mode));
  if (!scene.footings.empty()) return "knows no footing ([[footing]])";
  if (!scene.sheets.empty()) return "knows no sheet ([[sheet]])";
  return "";
}

}  // namespace porosph
