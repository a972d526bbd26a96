#include "solver/case/check_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/water/flow/outline.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;

/// Settings of soils that the mode of the water does not use.
void check_unused(const Case& c, Issues& issues) {
  const bool flows = c.water.flows(), steady = c.water.mode == WaterMode::steady;
  for (std::size_t i = 0; i < c.soils.size(); ++i) {
    const SoilCase& soil = c.soils[i];
    const auto unused = [&](bool given, std::string_view key, std::string_view mode) {
      if (given)
        issues.push_back(
            {fmt::format("soil[{}].{}", i, key), fmt::format("is used only with water.mode = {}", mode)});
    };
    unused(!flows && soil.permeability.x() > 0, "permeability", "\"steady\" or \"coupled\"");
    unused(!steady && soil.retention.model != RetentionModel::saturated, "retention", "\"steady\"");
    unused(flows && steady && soil.porosity > 0, "porosity", "\"coupled\"");
  }
}

void check_steady(const Case& c, Issues& issues) {
  if (c.loading.k0_stress)
    issues.push_back(
        {"loading.k0_stress", "is for water under a level: the soil comes to rest from no stress"});
  const bool drains = std::ranges::any_of(c.water.faces, [](const HydraulicFaceCase& f) {
    return f.kind == FaceKind::head || f.kind == FaceKind::seepage;
  });
  if (!drains)
    issues.push_back(
        {"water", "needs a [[water.face]] of kind \"head\" or \"seepage\": without one no head is given"});
}

void check_coupled(const Case& c, Issues& issues) {
  if (c.loading.damping > 0 || c.loading.adaptive_damping)
    issues.push_back({"loading.damping", "is not used with water.mode = \"coupled\": the soil is at rest"});
  if (c.stop.unbalanced_force_ratio > 0)
    issues.push_back({"stop.unbalanced_force_ratio",
                      "is not used with water.mode = \"coupled\": the soil is at rest all the while"});
  for (std::size_t i = 0; i < c.soils.size(); ++i)
    if (c.soils[i].no_tension || c.soils[i].law != LawKind::elastic)
      issues.push_back({fmt::format("soil[{}].{}", i, c.soils[i].no_tension ? "no_tension" : "law"),
                        "is not available with water.mode = \"coupled\": the soil must be linear elastic"});
  for (std::size_t i = 0; i < c.water.faces.size(); ++i)
    if (c.water.faces[i].kind == FaceKind::seepage)
      issues.push_back({fmt::format("water.face[{}].kind", i),
                        "must be \"head\", \"closed\" or \"flux\" with water.mode = \"coupled\""});
  double top = -never;
  for (const SoilCase& soil : c.soils)
    for (const Point& p : soil.polygon) top = std::max(top, p.y());
  if (c.water.present() && c.water.stretches.front().level < top)
    issues.push_back({"water.level",
                      fmt::format("must be >= {:g} m, the top of the soil: coupled soil is saturated", top)});
}

}  // namespace

std::vector<CaseIssue> check_flow_settings(const Case& c) {
  Issues issues;
  check_unused(c, issues);
  if (!c.water.flows()) return issues;
  for (std::size_t i = 0; i < c.soils.size(); ++i)
    if (!(c.soils[i].permeability.x() > 0))
      issues.push_back({fmt::format("soil[{}].permeability", i), "is missing: water flows in this soil"});
  if (c.formulation.motion != Motion::consistent)
    issues.push_back({"formulation.motion", "must be \"consistent\" where water flows"});
  c.water.mode == WaterMode::steady ? check_steady(c, issues) : check_coupled(c, issues);
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
