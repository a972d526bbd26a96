#include "solver/case/check_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/water/flow/outline.hpp"

namespace porosph {
namespace {

using Issues = std::vector<CaseIssue>;

void check_soils_that_stand(const Case& c, Issues& issues) {
  constexpr const char* only = "is used only with water.mode = \"steady\"";
  for (std::size_t i = 0; i < c.soils.size(); ++i) {
    if (c.soils[i].permeability.x() > 0) issues.push_back({fmt::format("soil[{}].permeability", i), only});
    if (c.soils[i].retention.model != RetentionModel::saturated)
      issues.push_back({fmt::format("soil[{}].retention", i), only});
  }
}

}  // namespace

std::vector<CaseIssue> check_flow_settings(const Case& c) {
  Issues issues;
  if (!c.water.flows()) {
    check_soils_that_stand(c, issues);
    return issues;
  }
  for (std::size_t i = 0; i < c.soils.size(); ++i)
    if (!(c.soils[i].permeability.x() > 0))
      issues.push_back({fmt::format("soil[{}].permeability", i), "is missing: water flows in this soil"});
  if (c.formulation.motion != Motion::consistent)
    issues.push_back({"formulation.motion", "must be \"consistent\" where water flows"});
  if (c.loading.k0_stress)
    issues.push_back(
        {"loading.k0_stress", "is for water that stands still: the soil comes to rest from no stress"});
  const bool drains = std::ranges::any_of(c.water.faces, [](const HydraulicFaceCase& f) {
    return f.kind == FaceKind::head || f.kind == FaceKind::seepage;
  });
  if (!drains)
    issues.push_back(
        {"water", "needs a [[water.face]] of kind \"head\" or \"seepage\": without one no head is given"});
  return issues;
}

std::vector<CaseIssue> check_faces(const Case& c) {
  Issues issues;
  if (!c.water.flows()) return issues;
  for (std::size_t i = 0; i < c.water.faces.size(); ++i)
    if (!touches(c.water.faces[i], c.soils, c.particles.spacing))
      issues.push_back({fmt::format("water.face[{}]", i), "lies on no outline of the soils"});
  if (!issues.empty()) return issues;
  const HydraulicOutline outline = hydraulic_outline(c.soils, c.water.faces, c.particles.spacing);
  if (const std::string unnamed = unnamed_stretch(outline); !unnamed.empty())
    issues.push_back(
        {"water", fmt::format("no [[water.face]] names the outline from {}; one without 'from' and 'to' "
                              "names all of it",
                              unnamed)});
  return issues;
}

}  // namespace porosph
