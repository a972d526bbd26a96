#include "solver/case/check_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/case/pores.hpp"
#include "solver/water/flow/outline.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;

/// Settings of soils that the mode of the water does not use.
void check_unused(const Case& c, Issues& issues) {
  const bool steady = c.water.mode == WaterMode::steady, transient = c.water.mode == WaterMode::transient;
  const bool seeps = steady || transient || c.water.mode == WaterMode::coupled;
  for (std::size_t i = 0; i < c.soils.size(); ++i) {
    const SoilCase& soil = c.soils[i];
    const auto unused = [&](bool given, std::string_view key, std::string_view mode) {
      if (given)
        issues.push_back(
            {fmt::format("soil[{}].{}", i, key), fmt::format("is used only with water.mode = {}", mode)});
    };
    unused(!seeps && soil.permeability.x() > 0, "permeability", "\"steady\", \"coupled\" or \"transient\"");
    unused(c.water.mode != WaterMode::coupled && soil.permeability_law != PermeabilityLaw::constant,
           "permeability_law", "\"coupled\"");
    unused(!steady && !transient && soil.retention.model != RetentionModel::saturated, "retention",
           "\"steady\" or \"transient\"");
    unused(!transient && !c.water.couples() && soil.porosity > 0, "porosity",
           "\"coupled\", \"undrained\" or \"transient\"");
    const double porosity = porosity_of(soil);
    if (soil.retention.residual >= porosity)
      issues.push_back({fmt::format("soil[{}].retention.residual", i),
                        fmt::format("must be < {:g}, the porosity", porosity)});
  }
}

/// What changes over time does so in seepage over time alone.
void check_constant(const Case& c, Issues& issues) {
  for (std::size_t i = 0; i < c.water.faces.size(); ++i)
    if (c.water.faces[i].changes())
      issues.push_back(
          {fmt::format("water.face[{}].{}", i,
                       c.water.faces[i].level_over_time.empty() ? "rate_over_time" : "level_over_time"),
           "needs water.mode = \"transient\""});
}

void check_transient(const Case& c, Issues& issues) {
  if (c.water.coupling.motion == WaterMotion::dynamic)
    issues.push_back(
        {"water.motion", "must be \"quasi_static\" or \"automatic\" with water.mode = \"transient\""});
  if (c.water.coupling.motion == WaterMotion::automatic && c.water.transient.rigid)
    issues.push_back({"water.motion", "must be \"quasi_static\" with water.rigid_soil: nothing fails"});
  if (c.loading.k0_stress)
    issues.push_back(
        {"loading.k0_stress", "is for water under a level: the soil comes to rest from no stress"});
  if (c.loading.damping > 0 || c.loading.adaptive_damping)
    issues.push_back({"loading.damping", "is not used with water.mode = \"transient\": the soil is at rest"});
  if (!c.loading.gravity_applied && !c.water.transient.rigid)
    issues.push_back({"loading.gravity_applied",
                      "must be true with water.mode = \"transient\", or water.rigid_soil must be"});
  const bool reached = !c.water.drains.empty() || std::ranges::any_of(c.water.faces, [](const auto& f) {
    return f.kind != FaceKind::closed;
  });
  if (!reached) issues.push_back({"water", "needs a [[water.face]] or [[water.drain]] that water passes"});
}

void check_steady(const Case& c, Issues& issues) {
  check_constant(c, issues);
  if (c.loading.k0_stress)
    issues.push_back(
        {"loading.k0_stress", "is for water under a level: the soil comes to rest from no stress"});
  const bool drains = std::ranges::any_of(c.water.faces, [](const HydraulicFaceCase& f) {
    return f.kind == FaceKind::head || f.kind == FaceKind::seepage;
  });
  if (!drains && c.water.drains.empty())
    issues.push_back(
        {"water", "needs a [[water.face]] of kind \"head\" or \"seepage\": without one no head is given"});
}

void check_coupled(const Case& c, Issues& issues) {
  check_constant(c, issues);
  const std::string mode = fmt::format("water.mode = \"{}\"", name(c.water.mode));
  const bool rests = !c.water.is_dynamic();
  if (rests && (c.loading.damping > 0 || c.loading.adaptive_damping))
    issues.push_back({"loading.damping", fmt::format("is not used with {}: the soil is at rest", mode)});
  if (rests && c.stop.unbalanced_force_ratio > 0)
    issues.push_back({"stop.unbalanced_force_ratio",
                      fmt::format("is not used with {}: the soil is at rest all the while", mode)});
  for (std::size_t i = 0; i < c.water.faces.size(); ++i)
    if (c.water.faces[i].kind == FaceKind::seepage || c.water.faces[i].kind == FaceKind::rain)
      issues.push_back({fmt::format("water.face[{}].kind", i),
                        fmt::format("must be \"head\", \"closed\" or \"flux\" with {}", mode)});
  double top = -never;
  for (const SoilCase& soil : c.soils)
    for (const Point& p : soil.polygon) top = std::max(top, p.y());
  if (c.water.present() && c.water.stretches.front().level < top)
    issues.push_back(
        {"water.level", fmt::format("must be >= {:g} m, the top of the soil: {} soil is saturated", top,
                                    name(c.water.mode))});
}

/// A particle stands for a well of its own radius; a smaller one resists more. Both are known where k is the
/// same in all directions.
void check_wells(const Case& c, Issues& issues) {
  const double most = DrainCase::own_radius * c.particles.spacing;
  const bool even = std::ranges::all_of(
      c.soils, [](const SoilCase& soil) { return soil.permeability.x() == soil.permeability.y(); });
  for (std::size_t i = 0; i < c.water.drains.size(); ++i) {
    const double radius = c.water.drains[i].radius;
    const std::string key = fmt::format("water.drain[{}].radius", i);
    if (radius >= most)
      issues.push_back({key, fmt::format("must be < {:.4g} m, the radius that its particle stands for (0.163 "
                                         "spacings), but is {:g}; leave it out, or use finer particles",
                                         most, radius)});
    else if (radius > 0 && !even)
      issues.push_back({key, "needs soils whose permeability is the same in x and y"});
  }
}

}  // namespace

std::vector<CaseIssue> check_flow_settings(const Case& c) {
  Issues issues;
  check_unused(c, issues);
  if (!c.water.flows()) return issues;
  check_wells(c, issues);
  for (std::size_t i = 0; i < c.soils.size(); ++i)
    if (c.water.mode != WaterMode::undrained && !(c.soils[i].permeability.x() > 0))
      issues.push_back({fmt::format("soil[{}].permeability", i), "is missing: water flows in this soil"});
  if (c.formulation.motion != Motion::consistent)
    issues.push_back({"formulation.motion", "must be \"consistent\" where water flows"});
  switch (c.water.mode) {
    case WaterMode::still:
      break;
    case WaterMode::steady:
      check_steady(c, issues);
      break;
    case WaterMode::coupled:
    case WaterMode::undrained:
      check_coupled(c, issues);
      break;
    case WaterMode::transient:
      check_transient(c, issues);
      break;
  }
  return issues;
}

std::vector<CaseIssue> check_faces(const Case& c) {
  Issues issues;
  if (!c.water.flows()) return issues;
  for (std::size_t i = 0; i < c.water.faces.size(); ++i)
    if (!touches(c.water.faces[i], c.soils, c.particles.spacing))
      issues.push_back({fmt::format("water.face[{}]", i), "lies on no outline of the soils"});
  if (!issues.empty() || c.water.mode != WaterMode::steady) return issues;
  const HydraulicOutline outline = hydraulic_outline(c.soils, c.water.faces, c.particles.spacing);
  if (const std::string unnamed = unnamed_stretch(outline); !unnamed.empty())
    issues.push_back(
        {"water", fmt::format("no [[water.face]] names the outline from {}; one without 'from' and 'to' "
                              "names all of it",
                              unnamed)});
  return issues;
}

}  // namespace porosph
