#include "render/report/safety_study.hpp"

#include <fmt/format.h>

namespace porosph::render {
namespace {

using Rows = std::vector<std::vector<std::string>>;

StudySection factors(const SafetyAnswer& answer) {
  Rows rows = {{"Method", "Factor of safety", "Run time [s]"}};
  if (answer.particles)
    rows.push_back({"Strength reduction in the particles", bracket_text(*answer.particles),
                    fmt::format("{:.2f}", answer.particle_seconds)});
  for (const NamedSurface& s : slip_surfaces(answer))
    rows.push_back({"Limit equilibrium: " + s.name, fmt::format("{:.3f}", s.surface.factor),
                    fmt::format("{:.2f}", answer.limit_equilibrium_seconds)});
  StudySection section{.heading = "Factor of safety",
                       .paragraphs = answer.warnings,
                       .tables = {{.caption = "", .rows = std::move(rows)}},
                       .pictures = {}};
  section.pictures.push_back(
      {.file = "mechanism.png",
       .description = "How the body fails",
       .caption =
           answer.particles && answer.particles->mechanism
               ? "Plastic strain where the strength was divided by the smallest factor at which it failed."
               : "The soils, and the slip surfaces with the smallest factors."});
  return section;
}

StudySection trials(const StrengthReduction& found) {
  Rows rows = {
      {"Strength divided by", "Outcome", "Largest displacement [m]", "Unbalanced force ratio", "Steps"}};
  for (const StrengthTrial& t : found.trials)
    rows.push_back({fmt::format("{:.4f}", t.factor), std::string(words_of(t.end)),
                    fmt::format("{:.4g}", t.displacement), fmt::format("{:.1e}", t.unbalanced),
                    fmt::format("{}", t.steps)});
  return {
      .heading = "Trials",
      .paragraphs = {"Cohesion, undrained strength and the tangent of the friction angle were divided by a "
                     "factor, and the body computed to its rest."},
      .tables = {{.caption = "", .rows = std::move(rows)}},
      .pictures = {{.file = "safety.png",
                    .description = "Displacement over the factor that the strength is divided by",
                    .caption = "The curve bends upwards where the body fails."}}};
}

}  // namespace

Study safety_study(const SafetyAnswer& answer, const std::string& command) {
  Study study{.title = "Factor of safety: " + answer.title,
              .lead = "By how much the strength of the soil can be divided before the body fails.",
              .sections = {factors(answer)},
              .files = {},
              .command = command};
  if (answer.particles) {
    study.sections.push_back(trials(*answer.particles));
    study.files.emplace_back("safety.csv");
  }
  if (answer.limit_equilibrium) study.files.emplace_back("slip_surfaces.csv");
  return study;
}

}  // namespace porosph::render
