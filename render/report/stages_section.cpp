#include "render/report/stages_section.hpp"

#include <fmt/format.h>

#include <cmath>

#include "render/report/html.hpp"

namespace porosph {
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

std::string table_of(const std::vector<Summary::Stage>& stages) {
  std::vector<std::vector<std::string>> rows = {
      {"Stage", "From [s]", "To [s]", "Ended by", "Steps", "Particles", "Largest displacement [mm]"}};
  for (const auto& [name, probe] : stages.front().probes) rows[0].push_back(name + ": u_x, u_y; σ'yy");
  for (const Summary::Stage& s : stages) {
    rows.push_back({s.name, fmt::format("{:.4g}", s.start), fmt::format("{:.4g}", s.time),
                    ending_text(s.ended), fmt::format("{}", s.steps), fmt::format("{}", s.particles),
                    fmt::format("{:.4g}", 1e3 * s.largest_displacement)});
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

}  // namespace porosph
