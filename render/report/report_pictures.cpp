#include "render/report/report_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/report/comparison.hpp"
#include "render/run/history_lines.hpp"
#include "render/run/run_panel.hpp"
#include "render/run/section_chart.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph {
namespace {

namespace fs = std::filesystem;

/// Frame numbers, closer together at the start, where most happens.
std::vector<std::size_t> instants(std::size_t frames) {
  constexpr int count = 6;
  std::set<std::size_t> chosen;
  for (int i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / count;
    chosen.insert(static_cast<std::size_t>(std::lround(part * part * static_cast<double>(frames - 1))));
  }
  return {chosen.begin(), chosen.end()};
}

/// Of the first three probes that are some distance apart, or the middle of the soil.
std::vector<double> verticals_of(const Case& scene) {
  double low = never, high = -never;
  for (const SoilCase& soil : scene.soils)
    for (const Point& p : soil.polygon) low = std::min(low, p.x()), high = std::max(high, p.x());
  constexpr std::size_t most = 3;
  const double apart = 0.05 * (high - low);
  std::vector<double> places;
  for (const ProbeCase& probe : scene.probes)
    if (places.size() < most &&
        std::ranges::none_of(places, [&](double x) { return std::abs(x - probe.position.x()) < apart; }))
      places.push_back(probe.position.x());
  if (places.empty()) places.push_back(0.5 * (low + high));
  return places;
}

/// The run's last frame on a vertical; nothing where the soil has left it.
std::optional<RunSection> vertical_of(const LoadedRun& run, const SectionLine& line,
                                      const std::vector<FieldSelection>& fields) {
  try {
    return section_of(run.run, run.label, run.last, line, 0, fields);
  } catch (const NoSoil&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<ReportPicture> draw_sections(const std::vector<LoadedRun>& runs,
                                           const std::optional<FemReference>& fem, const fs::path& folder) {
  const Case& scene = *runs.front().run.scene;
  const FieldSelection field{"EffectiveStress", "YY"};
  std::vector<Chart> charts;
  std::vector<RunSection> all;
  for (const double x : verticals_of(scene)) {
    const SectionLine line{.kind = SectionLine::vertical, .points = {}, .at = x};
    std::vector<RunSection> sections, references;
    for (const LoadedRun& run : runs)
      if (auto section = vertical_of(run, line, {field})) sections.push_back(std::move(*section));
    if (sections.empty()) continue;
    if (auto exact = exact_section(scene, sections.front())) references.push_back(std::move(*exact));
    if (fem) references.push_back(fem_section(*fem, sections.front()));
    charts.push_back(section_chart(line, sections, references, field));
    charts.back().title = "At " + line.text();
    all.insert(all.end(), sections.begin(), sections.end());
    all.insert(all.end(), references.begin(), references.end());
  }
  if (charts.empty()) return std::nullopt;
  save_charts(section_figure({.kind = SectionLine::vertical, .points = {}, .at = 0}, std::move(charts),
                             shown_name(field) + " with height"),
              folder / "sections.png");
  write_file(folder / "sections.csv", section_csv(all, {field}));
  return ReportPicture{"sections.png", shown_name(field) + " along verticals through the soil",
                       fmt::format("{} on verticals at the end of {}. The numbers are in sections.csv.",
                                   shown_name(field), runs.size() == 1 ? "the run" : "each run")};
}

ReportPicture draw_case(const LoadedRun& loaded, const fs::path& folder) {
  const FinishedRun& run = loaded.run;
  const Frame start = frame_of(run, 0);
  const bool several = run.scene->soils.size() > 1;
  const FieldSelection field{several                      ? "SoilId"
                             : run.scene->water.present() ? "PorePressure"
                                                          : "Density",
                             ""};
  const auto values = values_of(start, field);
  const ShownUnit unit = shown_unit(field.name, largest_of(values));
  ContourPanel panel = panel_of(run, start, scaled(values, unit.factor));
  panel.title = shown_name(field) + " at the start";
  ColourScale scale = scale_of(field, unit, run.scene, std::nullopt);
  scale.map = ColourMap::cividis;
  save_contours({.title = run.scene->title, .panels = {std::move(panel)}, .scale = scale, .columns = 1},
                folder / "case.png");
  std::string soils;
  for (const SoilCase& s : run.scene->soils) soils += (soils.empty() ? "" : ", ") + s.name;
  return {
      "case.png", "The case: soils, boundaries, water level and probes",
      fmt::format(
          "The case at the start: {} particles, soils: {}. Circles: rollers; hatched: fixed; blue: water.",
          values.size(), soils)};
}

ReportPicture draw_contours(const std::vector<LoadedRun>& runs, const std::optional<FemReference>& fem,
                            const FieldSelection& field, const fs::path& folder) {
  std::vector<std::vector<double>> values;
  double largest = 0;
  for (const LoadedRun& r : runs) {
    values.push_back(values_of(r.last, field));
    largest = std::max(largest, largest_of(values.back()));
  }
  const ShownUnit unit = shown_unit(field.name, largest);
  ContourFigure figure;
  figure.title = shown_name(field);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    values[i] = scaled(std::move(values[i]), unit.factor);
    ContourPanel panel = panel_of(runs[i].run, runs[i].last, values[i]);
    panel.title = runs[i].label;
    panel.subtitle = panel_subtitle(runs[i].run, runs[i].last.time, runs[i].label);
    figure.panels.push_back(std::move(panel));
  }
  if (fem) {
    figure.panels.push_back(fem_panel(*fem, runs.front().run, runs.front().last, field, unit.factor));
    values.push_back(figure.panels.back().particles.values);
  }
  figure.scale = scale_of(field, unit, runs.front().run.scene, range_of_runs(values, usual_map(field)), true);
  const std::string file = "contours_" + file_name(field.text()) + ".png";
  save_contours(figure, folder / file);
  return {file, shown_name(field) + " of all runs",
          fmt::format("{} at the end of {}, one range of colours for all.", shown_name(field),
                      runs.size() == 1 ? "the run" : "each run")};
}

std::optional<ReportPicture> draw_differences(const std::vector<LoadedRun>& runs,
                                              const std::optional<FemReference>& fem,
                                              const std::vector<LeftOut>& left_out,
                                              const FieldSelection& field, const fs::path& folder) {
  std::vector<const FinishedRun*> finished;
  std::vector<const Frame*> frames;
  std::vector<std::string> labels;
  for (const LoadedRun& r : runs) {
    finished.push_back(&r.run);
    frames.push_back(&r.last);
    labels.push_back(r.label);
  }
  const ContourFigure figure = difference_maps(finished, frames, labels, fem, left_out, field);
  if (figure.panels.empty()) return std::nullopt;
  const std::string file = "differences_" + file_name(field.text()) + ".png";
  save_contours(figure, folder / file);
  return ReportPicture{
      file, "Maps of differences in " + name_in_sentence(field),
      fmt::format("Differences in {}, each with a range of colours of its own: relative L2 norm, and the "
                  "largest difference with its place.",
                  name_in_sentence(field))};
}

std::optional<ReportPicture> draw_histories(const std::vector<FinishedRun>& runs,
                                            const std::vector<std::string>& labels, const fs::path& folder) {
  const std::vector<Chart> charts = stress_histories(runs, labels);
  if (charts.empty()) return std::nullopt;
  const bool theory = !charts.front().references.empty();
  save_charts({.title = "Effective vertical stress over time", .charts = charts}, folder / "history.png");
  return ReportPicture{"history.png", "Effective vertical stress over time at the probes",
                       std::string("Effective vertical stress at the probes") +
                           (theory ? ", and the value that theory gives at rest (finite strain)." : ".")};
}

std::optional<ReportPicture> draw_probe(const std::vector<LoadedRun>& runs, const FemReference& fem,
                                        const ProbeCase& probe, const fs::path& folder) {
  std::vector<Chart> charts;
  for (const char* component : {"XX", "YY", "ZZ", "XY"}) {
    const FieldSelection field{"EffectiveStress", component};
    const ShownUnit unit = shown_unit(field.name, 0);
    Chart chart{.title = shown_name(field),
                .x = {.title = "t [s]"},
                .y = {.title = shown_label(field, unit)},
                .series = {},
                .references = {}};
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (auto line = history_line(runs[i].run, probe.name, field.text(), unit.factor)) {
        line->label = runs[i].label;
        style(*line, i);
        mark_end(*line, runs[i].run);
        chart.series.push_back(std::move(*line));
      }
    if (chart.series.empty()) return std::nullopt;
    chart.references.push_back(
        {.label = "finite elements", .y = fem.values(field, {probe.position})[0] * unit.factor});
    charts.push_back(std::move(chart));
  }
  const std::string file = "history_" + file_name(probe.name) + ".png";
  save_charts(
      {.title = fmt::format("At {} ({:g}, {:g}) m", probe.name, probe.position.x(), probe.position.y()),
       .charts = charts,
       .columns = 2},
      folder / file);
  return ReportPicture{
      file, "Effective stresses over time at probe " + probe.name,
      fmt::format("Effective stresses at {}, and what finite elements give at rest.", probe.name)};
}

ReportPicture draw_development(const LoadedRun& loaded, const FieldSelection& field, const fs::path& folder) {
  const FinishedRun& run = loaded.run;
  std::vector<Frame> frames;
  std::vector<std::vector<double>> values;
  double largest = 0;
  for (std::size_t i : instants(run.series.frames.size())) {
    frames.push_back(frame_of(run, i));
    values.push_back(values_of(frames.back(), field));
    largest = std::max(largest, largest_of(values.back()));
  }
  const ShownUnit unit = shown_unit(field.name, largest);
  ContourFigure figure;
  figure.title = shown_name(field) + ": " + loaded.label;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    values[i] = scaled(std::move(values[i]), unit.factor);
    ContourPanel panel = panel_of(run, frames[i], values[i]);
    panel.title = time_text(frames[i].time);
    figure.panels.push_back(std::move(panel));
  }
  std::vector<ValueRange> extents;
  for (const auto& v : values) extents.push_back(robust_extent(v));
  figure.scale = scale_of(field, unit, run.scene, range_of_instants(extents, usual_map(field)), true);
  const std::string file = "development_" + file_name(loaded.run.name) + ".png";
  save_contours(figure, folder / file);
  return {file, shown_name(field) + " over time in run " + loaded.label,
          fmt::format("How the {} develops in {}.", name_in_sentence(field), loaded.label)};
}

}  // namespace porosph
