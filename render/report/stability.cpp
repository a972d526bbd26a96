#include "render/report/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/category_map.hpp"
#include "render/report/study.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph::render {
namespace {

// M. Okabe and K. Ito (2008), Color universal design; they differ in lightness too.
constexpr std::array<Colour, stability_classes> colours = {
    {{0, 158, 115}, {240, 228, 66}, {86, 180, 233}, {213, 94, 0}, {60, 20, 80}, {215, 215, 215}}};

std::string percent(double fraction) {
  if (!std::isfinite(fraction)) return "";
  return fraction < 0.99 ? fmt::format("{:.2g} %", 100 * fraction)
                         : (fraction < 10 ? fmt::format("{:.0f} %", 100 * fraction) : "> 1000 %");
}

std::string seconds(double t) { return fmt::format("{:.2g} s", t); }

std::string legend_text(StabilityClass c, const Sweep& sweep) {
  const SweepLimits& limits = sweep.limits;
  const bool of_energy = sweep.reference == SweepReference::energy;
  switch (c) {
    case StabilityClass::accurate:
      if (of_energy) return fmt::format("numerics took up to {:.2g} %", 100 * limits.accurate);
      return fmt::format("accurate: error up to {:.2g} %", 100 * limits.accurate);
    case StabilityClass::inaccurate:
      return of_energy ? "numerics took more" : "inaccurate: at rest at another stress";
    case StabilityClass::not_settled:
      return fmt::format("not settled: forces above {:g} of weight", limits.settled);
    case StabilityClass::unstable:
      return "unstable: when, and the first cause";
    case StabilityClass::thrown_out:
      return "thrown out: particles left, and when";
    case StabilityClass::refused:
      return "refused: not a valid case";
  }
  return "";
}

MapCell cell_of(const std::optional<Verdict>& v) {
  if (!v) return {};
  const int category = static_cast<int>(v->outcome);
  switch (v->outcome) {
    case StabilityClass::accurate:
    case StabilityClass::inaccurate:
      return {category, percent(v->error), ""};
    case StabilityClass::not_settled:
      return {category, percent(v->error), fmt::format("off {:.1e}", v->unbalanced)};
    case StabilityClass::unstable:
    case StabilityClass::thrown_out:
      return {category, seconds(v->time), v->cause};
    case StabilityClass::refused:
      return {category, "", ""};
  }
  return {};
}

MapAxis axis_of(const SweepAxis& axis, const std::vector<bool>& usual) {
  MapAxis out{axis.title, {}, usual};
  for (const SweepValue& value : axis.values) out.labels.push_back(value.label);
  return out;
}

/// "9 accurate, 3 unstable"
std::string counts(const SweptMap& map) {
  std::array<int, stability_classes> count{};
  for (const auto& v : map.verdicts)
    if (v) ++count[static_cast<std::size_t>(v->outcome)];
  std::string text;
  for (int c = 0; c < stability_classes; ++c)
    if (count[static_cast<std::size_t>(c)] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count[static_cast<std::size_t>(c)],
                          class_name(static_cast<StabilityClass>(c)));
  return text;
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–"; }

/// Every run that did not end accurate.
StudyTable failures_of(const SweptMap& map) {
  const Sweep& sweep = map.sweep;
  StudyTable table{.caption = "",
                   .rows = {{sweep.x.title + (sweep.y.title.empty() ? "" : " · " + sweep.y.title), "class",
                             "error", "forces out of balance", "until", "steps", "first cause"}},
                   .numbers = false};
  for (std::size_t i = 0; i < map.verdicts.size(); ++i) {
    const auto& v = map.verdicts[i];
    if (!v || v->outcome == StabilityClass::accurate) continue;
    const std::string y = sweep.y.values[i / sweep.x.values.size()].label;
    table.rows.push_back({sweep.x.values[i % sweep.x.values.size()].label + (y.empty() ? "" : " · " + y),
                          std::string(class_name(v->outcome)), percent(v->error), number(v->unbalanced),
                          number(v->time) + " s", fmt::to_string(v->steps), v->message});
  }
  if (table.rows.size() > 1) table.caption = "Runs that are not accurate:";
  return table;
}

StudySection section_of(const SweptMap& map) {
  StudySection section{.heading = map.sweep.title,
                       .paragraphs = {counts(map) + "."},
                       .tables = {},
                       .pictures = {{map.sweep.name + ".png", map.sweep.title + ": " + counts(map), ""}}};
  if (StudyTable table = failures_of(map); table.rows.size() > 1) section.tables.push_back(std::move(table));
  return section;
}

/// What the folder's study has beside these sections; nothing where files of it are gone.
Study study_there(const std::filesystem::path& folder, const std::vector<StudySection>& fresh) {
  Study study;
  try {
    if (is_study(folder)) study = read_study(folder);
  } catch (const ReadError&) {
    return {};
  }
  std::erase_if(study.sections, [&](const StudySection& old) {
    return std::any_of(fresh.begin(), fresh.end(),
                       [&](const StudySection& s) { return s.heading == old.heading; });
  });
  return study;
}

}  // namespace

void save_stability_map(const SweptMap& map, const std::filesystem::path& png) {
  CategoryMap picture{.title = map.sweep.title,
                      .x = axis_of(map.sweep.x, map.usual_x),
                      .y = axis_of(map.sweep.y, map.usual_y),
                      .categories = {},
                      .cells = {},
                      .notes = map.sweep.notes,
                      .mark_label = ""};
  for (int c = 0; c < stability_classes; ++c)
    picture.categories.push_back(
        {legend_text(static_cast<StabilityClass>(c), map.sweep), colours[static_cast<std::size_t>(c)]});
  for (const auto& verdict : map.verdicts) picture.cells.push_back(cell_of(verdict));
  for (const auto* usual : {&map.usual_x, &map.usual_y})
    if (std::find(usual->begin(), usual->end(), true) != usual->end())
      picture.mark_label = "the case's own settings";
  save_category_map(picture, png);
}

void write_stability_study(const std::vector<SweptMap>& maps, const std::string& command,
                           const std::filesystem::path& folder) {
  std::vector<StudySection> fresh;
  for (const SweptMap& map : maps) fresh.push_back(section_of(map));
  Study study = study_there(folder, fresh);
  study.title = "Stability maps";
  study.lead = "Each cell is a run, coloured by how it ended.";
  study.sections.insert(study.sections.end(), fresh.begin(), fresh.end());
  for (const SweptMap& map : maps) {
    std::erase(study.files, map.sweep.name + ".csv");
    study.files.push_back(map.sweep.name + ".csv");
  }
  study.command += (study.command.empty() ? "" : "\n") + command;
  write_study(study, folder);
}

}  // namespace porosph::render
