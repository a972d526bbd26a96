#include "render/report/stages_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/report/html.hpp"
#include "vtk_io/run_folder/safety_files.hpp"

namespace porosph::render {
namespace {

std::string ending_text(const std::string& ended) {
  if (ended == "time") return "its time";
  return ended == "interrupted" ? "an interruption" : ended;
}

/// "u 1.2, -3.4 mm; σ'yy -45 kPa"; nothing where its soil is not there.
std::string probe_text(const Summary::Probe& probe) {
  const auto value = [&](const char* name) { return probe.values.at(name); };
  if (!std::isfinite(value("Displacement_Y"))) return "–";
  return fmt::format("{:.3g}, {:.3g} mm; {:.4g} kPa", 1e3 * value("Displacement_X"),
                     1e3 * value("Displacement_Y"), value("EffectiveStress_YY") / 1e3);
}

/// "1.35 to 1.36; 1.38 on slip surfaces"
std::string safety_text(const Summary::Safety& safety) {
  const bool bracketed = safety.stable_at > 0 || std::isfinite(safety.fails_at);
  std::string text = bracketed ? bracket_text(safety.stable_at, safety.fails_at) : "none";
  if (safety.limit_equilibrium > 0)
    text += fmt::format("; {:.3f} on slip surfaces", safety.limit_equilibrium);
  return text;
}

/// "plate: 51.4 kN/m, 40 mm"
std::string footing_text(const std::map<std::string, Summary::Footing>& footings) {
  std::string text;
  for (const auto& [name, f] : footings)
    text += fmt::format("{}{}: {:.4g} kN/m, {:.3g} mm", text.empty() ? "" : "; ", name, f.force / 1e3,
                        1e3 * f.settlement);
  return text;
}

/// "wall: 51.4 kNm/m, 4 mm"
std::string sheet_text(const std::map<std::string, Summary::Sheet>& sheets) {
  std::string text;
  for (const auto& [name, s] : sheets)
    text += fmt::format("{}{}: {:.4g} kNm/m, {:.3g} mm", text.empty() ? "" : "; ", name, s.moment / 1e3,
                        1e3 * s.displacement);
  return text;
}

std::string table_of(const std::vector<Summary::Stage>& stages) {
  std::vector<std::vector<std::string>> rows = {
      {"Stage", "From [s]", "To [s]", "Ended by", "Steps", "Particles", "Largest displacement [mm]"}};
  const bool safety = std::ranges::any_of(stages, [](const auto& s) { return s.safety.has_value(); });
  if (safety) rows[0].push_back("Factor of safety");
  const bool footings = std::ranges::any_of(stages, [](const auto& s) { return !s.footings.empty(); });
  if (footings) rows[0].push_back("Footings");
  const bool sheets = std::ranges::any_of(stages, [](const auto& s) { return !s.sheets.empty(); });
  if (sheets) rows[0].push_back("Sheets");
  for (const auto& [name, probe] : stages.front().probes) rows[0].push_back(name + ": u_x, u_y; σ'yy");
  for (const Summary::Stage& s : stages) {
    rows.push_back({s.name, fmt::format("{:.4g}", s.start), fmt::format("{:.4g}", s.time),
                    ending_text(s.ended), fmt::format("{}", s.steps), fmt::format("{}", s.particles),
                    fmt::format("{:.4g}", 1e3 * s.largest_displacement)});
    if (safety) rows.back().push_back(s.safety ? safety_text(*s.safety) : "");
    if (footings) rows.back().push_back(footing_text(s.footings));
    if (sheets) rows.back().push_back(sheet_text(s.sheets));
    for (const auto& [name, probe] : s.probes) rows.back().push_back(probe_text(probe));
  }
  return html::table(rows);
}

}  // namespace

std::string stages_section(const std::vector<std::string>& labels, const std::vector<Summary>& summaries) {
  std::string text;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    if (summaries[i].stages.empty()) continue;
    if (summaries.size() > 1) text += html::paragraph(labels[i]);
    text += table_of(summaries[i].stages);
  }
  return text.empty() ? text : html::section("Stages", text);
}

}  // namespace porosph::render
