#include "app/check_by_fem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/memory.hpp"
#include "app/stopwatch.hpp"
#include "solver/case/fem_obstacle.hpp"
#include "solver/reference/fem/compare.hpp"
#include "solver/reference/fem/demand.hpp"
#include "solver/reference/fem/solve.hpp"
#ifdef POROSPH_HAS_VTK
#include "vtk_io/fem_mesh.hpp"
#endif

namespace porosph::app {
namespace {

constexpr double part_of_the_run = 0.1, always_affordable = 1;  // s
constexpr double at_rest = 1e-3;                                // unbalanced force ratio
constexpr double motionless = 1e-4;                             // kinetic over elastic energy

/// The finest of these that is affordable is taken; P4 triangles are accurate with few.
constexpr std::initializer_list<double> triangle_counts = {1600, 800, 400};

/// Leaves most of the memory to others.
double most_bytes() { return std::min(2e9, memory_here() / 4); }

/// What stands against any comparison of this case.
std::string obstacle([[maybe_unused]] const Case& scene) {
#ifndef POROSPH_HAS_VTK
  return "this program was built without VTK, which makes the mesh";
#else
  return fem_obstacle(scene);
#endif
}

/// The longest edge of those that are fine enough, or nothing.
std::optional<double> affordable_edge(const Case& scene, double seconds, FemDemand& least) {
  for (const double triangles : triangle_counts) {
    const double edge = fem_edge(scene, triangles);
    least = fem_demand(scene, edge);
    if (least.seconds <= seconds && least.bytes <= most_bytes()) return edge;
  }
  return std::nullopt;
}

/// Why the state is not one of rest; empty if it is.
std::string unrest(Simulation& s, const Summary& outcome) {
  if (outcome.status == RunStatus::unstable) return "the run became unstable";
  if (outcome.status == RunStatus::interrupted) return "the run was interrupted";
  if (!(outcome.unbalanced_force_ratio < at_rest))
    return fmt::format(
        "the run ended in motion: its unbalanced force ratio is {:.1e}, at rest it is below {:g}",
        outcome.unbalanced_force_ratio, at_rest);
  const Simulation::Energy energy = s.energy();
  if (!(energy.kinetic < motionless * energy.elastic)) return "the run ended in motion";
  return "";
}

FemCheck skipped(std::string reason) {
  FemCheck check;
  check.skipped = std::move(reason);
  return check;
}

/// In the case's coordinates, which positions are not where those are large.
[[maybe_unused]] Particles in_coordinates_of_the_case(const Model& model) {
  Particles p = model.particles;
  for (Vec2& x : p.start) x += model.origin;
  for (Vec2& x : p.position) x += model.origin;
  return p;
}

FemCheck compare([[maybe_unused]] Simulation& s, [[maybe_unused]] double edge) {
#ifdef POROSPH_HAS_VTK
  const Stopwatch watch;
  const Particles particles = in_coordinates_of_the_case(s.model());
  FemCheck check = compare_with_fem(s.scene(), particles, solve_fem(s.scene(), mesh_case(s.scene(), edge)));
  check.warnings = fem_warnings(s.scene(), particles, check);
  check.seconds = watch.seconds();
  return check;
#else
  return {};
#endif
}

}  // namespace

void require_fem(const Case& scene) {
  const CheckCase& asked = scene.check;
  if (asked.finite_elements_auto || !asked.finite_elements) return;
  if (const std::string reason = obstacle(scene); !reason.empty())
    throw std::runtime_error("check.finite_elements = true: they are not possible: " + reason);
  FemDemand least;
  if (!affordable_edge(scene, never, least)) check_fem_demand(least, most_bytes());
}

std::string fem_outlook(const Case& scene) {
  const CheckCase& asked = scene.check;
  if (!asked.finite_elements_auto && !asked.finite_elements)
    return "not compared with: check.finite_elements = false";
  if (const std::string reason = obstacle(scene); !reason.empty()) return "not compared with: " + reason;
  try {
    const FemDemand demand = fem_demand(scene, fem_edge(scene, *triangle_counts.begin()));
    return fmt::format(
        "about {:.3g} unknowns, {:.1g} s{}", demand.unknowns, demand.seconds,
        asked.finite_elements_auto ? ", if that is less than a second or a tenth of the run" : "");
  } catch (const std::runtime_error& error) {
    return fmt::format("not compared with: {}", error.what());
  }
}

FemCheck check_by_fem(Simulation& s, const Summary& outcome) {
  const Case& scene = s.scene();
  const CheckCase& asked = scene.check;
  if (!asked.finite_elements_auto && !asked.finite_elements) return skipped("check.finite_elements = false");
  if (const std::string reason = obstacle(scene); !reason.empty()) return skipped(reason);
  if (const std::string reason = unrest(s, outcome); !reason.empty()) return skipped(reason);
  try {
    const double seconds = asked.finite_elements_auto
                               ? std::max(part_of_the_run * outcome.stepping_seconds, always_affordable)
                               : never;
    FemDemand least;
    const auto edge = affordable_edge(scene, seconds, least);
    if (!edge)
      return skipped(
          fmt::format("about {:.3g} unknowns would take more than a second and a tenth of the run; "
                      "check.finite_elements = true "
                      "compares nevertheless",
                      least.unknowns));
    return compare(s, *edge);
  } catch (const std::exception& error) {
    return skipped(error.what());
  }
}

std::string tell(const FemCheck& check) {
  if (!check.skipped.empty()) return fmt::format("not compared with finite elements: {}\n", check.skipped);
  std::string text;
  for (const auto& [name, soil] : check.soils) {
    text += fmt::format("soil '{}' against finite elements: ", name);
    if (soil.particles == 0) {
      text += "all of it is near points where stress is singular\n";
      continue;
    }
    bool first = true;
    for (const std::string_view kind : {"EffectiveStress", "Displacement"}) {
      const auto worst =
          std::max_element(soil.fields.begin(), soil.fields.end(), [&](const auto& a, const auto& b) {
            return (a.first.starts_with(kind) ? a.second.relative : -1) <
                   (b.first.starts_with(kind) ? b.second.relative : -1);
          });
      text += fmt::format("{}{} {} %", first ? "" : ", ", short_name(worst->first),
                          fmt::format("{:.2g}", 100 * worst->second.relative));
      first = false;
    }
    text += " off at most (L2)\n";
  }
  return text;
}

}  // namespace porosph::app
