#include "render/report/report_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/report/comparison.hpp"
#include "render/run/history_lines.hpp"
#include "render/run/run_panel.hpp"
#include "render/run/section_chart.hpp"
#include "render/run/stress_paths.hpp"
#include "render/run/time_axis.hpp"
#include "render/run/water_curves.hpp"
#include "solver/space/place_text.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"

namespace porosph::render {
namespace {

namespace fs = std::filesystem;

constexpr int narrow = 480, instant_width = 900;  // pixels

/// Names for the panels of a picture: "history_1.png", ...
std::vector<std::string> panel_names(const std::string& stem, std::size_t panels) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= panels; ++i) names.push_back(fmt::format("{}_{}.png", stem, i));
  return names;
}

std::vector<fs::path> within(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> paths;
  for (const std::string& name : names) paths.push_back(folder / name);
  return paths;
}

/// Draws the figure into STEM.png, and each of its panels for narrow windows.
ReportPicture draw(const ContourFigure& figure, const fs::path& folder, const std::string& stem,
                   const std::string& description, const std::string& caption) {
  save_contours(figure, folder / (stem + ".png"));
  const std::vector<std::string> names = panel_names(stem, figure.panels.size());
  save_each_panel(figure, narrow, within(folder, names));
  return {stem + ".png", description, caption, names};
}

ReportPicture draw(const ChartFigure& figure, const fs::path& folder, const std::string& stem,
                   const std::string& description, const std::string& caption) {
  save_charts(figure, folder / (stem + ".png"));
  const std::vector<std::string> names = panel_names(stem, figure.charts.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    save_charts({.title = "", .charts = {figure.charts[i]}, .width = narrow, .height = 360},
                folder / names[i]);
  return {stem + ".png", description, caption, names};
}

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

const SectionLine upright{.kind = SectionLine::vertical, .points = {}, .at = 0};

/// Of the first three probes that are some distance apart, or the middle of the soil.
std::vector<SectionLine> verticals_of(const Case& scene) {
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
  std::vector<SectionLine> lines(places.size(), upright);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].at = places[i];
  return lines;
}

/// The run's last frame on a line; nothing where the soil has left it.
std::optional<RunSection> end_on(const LoadedRun& run, const SectionLine& line,
                                 const std::vector<FieldSelection>& fields) {
  try {
    return section_of(run.run, run.label, run.last, line, 0, fields);
  } catch (const NoSoil&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<ReportPicture> draw_sections(const std::vector<LoadedRun>& runs,
                                           const std::optional<FemReference>& fem,
                                           const std::vector<SectionLine>& lines, const FieldSelection& field,
                                           const fs::path& folder) {
  const Case& scene = *runs.front().run.scene;
  std::vector<Chart> charts;
  std::vector<RunSection> all;
  for (const SectionLine& line : lines.empty() ? verticals_of(scene) : lines) {
    std::vector<RunSection> sections, references;
    for (const LoadedRun& run : runs)
      if (auto section = end_on(run, line, {field})) sections.push_back(std::move(*section));
    if (sections.empty()) continue;
    if (auto exact = exact_section(scene, sections.front())) references.push_back(std::move(*exact));
    if (fem) references.push_back(fem_section(*fem, sections.front()));
    charts.push_back(section_chart(line, sections, references, field));
    charts.back().title = "At " + line.text();
    all.insert(all.end(), sections.begin(), sections.end());
    all.insert(all.end(), references.begin(), references.end());
  }
  if (charts.empty()) return std::nullopt;
  write_file(folder / "sections.csv", section_csv(all, {field}));
  const SectionLine& shape = lines.empty() ? upright : lines.front();
  return draw(section_figure(shape, std::move(charts), shown_name(field) + " along sections"), folder,
              "sections", shown_name(field) + " along sections through the soil",
              fmt::format("{} along sections at the end of {}. The numbers are in sections.csv.",
                          shown_name(field), runs.size() == 1 ? "the run" : "each run"));
}

/// What tells most of the start, of the fields that were written.
std::string field_of_case(const Frame& start, const Case& scene) {
  const bool is_wet = scene.water.present() || scene.water.flows();
  const bool several = scene.soils.size() > 1;
  for (const auto& [name, is_wanted] :
       {std::pair("SoilId", several), {"PorePressure", is_wet}, {"Density", true}, {"SoilId", true}})
    if (is_wanted && can_show(start, name)) return name;
  return start.fields.front().name;
}

ReportPicture draw_case(const LoadedRun& loaded, const fs::path& folder) {
  const FinishedRun& run = loaded.run;
  const Frame start = frame_of(run, 0);
  const FieldSelection field{field_of_case(start, *run.scene), ""};
  const auto values = values_of(start, field);
  const ShownUnit unit = shown_unit(field.name, largest_of(values));
  ContourPanel panel = panel_of(run, start, scaled(values, unit.factor));
  panel.title = shown_name(field) + " at the start";
  ColourScale scale = scale_of(field, unit, run.scene, std::nullopt);
  scale.map = ColourMap::cividis;
  std::string soils;
  for (const SoilCase& s : run.scene->soils) soils += (soils.empty() ? "" : ", ") + s.name;
  return draw(
      ContourFigure{.title = run.scene->title, .panels = {std::move(panel)}, .scale = scale, .columns = 1},
      folder, "case", "The case: soils, boundaries, water level and probes",
      fmt::format(
          "The case at the start: {} particles, soils: {}. Circles: rollers; hatched: fixed; blue: water.",
          values.size(), soils));
}

ReportPicture draw_contours(const std::vector<LoadedRun>& runs, const std::optional<FemReference>& fem,
                            const ReportField& shown, const fs::path& folder) {
  const FieldSelection& field = shown.field;
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
  figure.scale = scale_of(field, unit, runs.front().run.scene,
                          shown.range ? shown.range : range_of_runs(values, usual_map(field)), !shown.range);
  return draw(figure, folder, "contours_" + file_name(field.text()), shown_name(field) + " of all runs",
              fmt::format("{} at the end of {}, one range of colours for all.", shown_name(field),
                          runs.size() == 1 ? "the run" : "each run"));
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
  return draw(figure, folder, "differences_" + file_name(field.text()),
              "Maps of differences in " + name_in_sentence(field),
              fmt::format("Differences in {}, each with a range of colours of its own: relative L2 norm, and "
                          "the largest difference with its place.",
                          name_in_sentence(field)));
}

std::optional<ReportPicture> draw_histories(const std::vector<FinishedRun>& runs,
                                            const std::vector<std::string>& labels, const fs::path& folder) {
  const std::vector<Chart> charts = stress_histories(runs, labels);
  if (charts.empty()) return std::nullopt;
  const bool theory = !charts.front().references.empty();
  return draw(ChartFigure{.title = "Effective vertical stress over time", .charts = charts}, folder,
              "history", "Effective vertical stress over time at the probes",
              std::string("Effective vertical stress at the probes") +
                  (theory ? ", and the value that theory gives at rest (finite strain)." : "."));
}

std::optional<ReportPicture> draw_settlement(const std::vector<FinishedRun>& runs,
                                             const std::vector<std::string>& labels, const fs::path& folder) {
  std::vector<Chart> charts = settlement_curves(runs, labels);
  if (charts.empty()) return std::nullopt;
  return draw(ChartFigure{.title = "Settlement over time", .charts = std::move(charts)}, folder, "settlement",
              "Settlement over time at the probes", "How far the probes have moved downwards.");
}

std::optional<ReportPicture> draw_water(const std::vector<FinishedRun>& runs,
                                        const std::vector<std::string>& labels, const fs::path& folder) {
  std::vector<Chart> charts = water_curves(runs, labels);
  if (charts.empty()) return std::nullopt;
  return draw(
      ChartFigure{.title = "Water over time", .charts = std::move(charts)}, folder, "water",
      "Water that entered and left, and discharge over time",
      "Water that entered and left through faces and drains since the start and that the soil gained, and "
      "what passes faces, drains and sections with a name.");
}

std::optional<ReportPicture> draw_stress_paths(const std::vector<FinishedRun>& runs,
                                               const std::vector<std::string>& labels,
                                               const fs::path& folder) {
  std::vector<FinishedRun> strong = runs;
  constexpr std::size_t most = 6;
  std::vector<ProbeCase>& probes = strong.front().scene->probes;
  std::erase_if(probes, [&](const ProbeCase& probe) {
    return strength_at(*runs.front().scene, probe.position).empty();
  });
  if (probes.size() > most) probes.resize(most);
  std::vector<std::vector<Chart>> kinds;
  for (const PathKind kind : {PathKind::pq, PathKind::st, PathKind::mohr})
    kinds.push_back(stress_paths(strong, labels, kind));
  ChartFigure figure{.title = "Stress paths", .charts = {}, .columns = 3};
  for (std::size_t i = 0; i < kinds.front().size(); ++i)
    for (std::vector<Chart>& charts : kinds) figure.charts.push_back(std::move(charts[i]));
  if (figure.charts.empty()) return std::nullopt;
  figure.width = 1600;
  figure.height = 36 + 420 * static_cast<int>(kinds.front().size());
  return draw(
      figure, folder, "stress_paths", "Stress paths and Mohr's circles at the probes",
      "Stress paths from the start to the end (dot), Mohr's largest circle at the end, and the strength of "
      "the soil around the probe; compression is positive.");
}

std::optional<ReportPicture> draw_probe(const std::vector<LoadedRun>& runs, const FemReference& fem,
                                        const ProbeCase& probe, const fs::path& folder) {
  std::vector<Chart> charts;
  for (const char* component : {"XX", "YY", "ZZ", "XY"}) {
    const FieldSelection field{"EffectiveStress", component};
    const ShownUnit unit = shown_unit(field.name, 0);
    Chart chart{.title = shown_name(field),
                .x = time_axis(),
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
    show_days_if_long(chart);
    charts.push_back(std::move(chart));
  }
  return draw(ChartFigure{.title = fmt::format("At {} {} m", probe.name, place_text(probe.position)),
                          .charts = charts,
                          .columns = 2},
              folder, "history_" + file_name(probe.name),
              "Effective stresses over time at probe " + probe.name,
              fmt::format("Effective stresses at {}, and what finite elements give at rest.", probe.name));
}

namespace {

/// Panels of a run's frames, with one range of colours.
ContourFigure figure_of_frames(const LoadedRun& loaded, const std::vector<std::size_t>& chosen,
                               const ReportField& shown) {
  const FinishedRun& run = loaded.run;
  const FieldSelection& field = shown.field;
  std::vector<Frame> frames;
  std::vector<std::vector<double>> values;
  double largest = 0;
  for (std::size_t i : chosen) {
    frames.push_back(frame_of(run, i));
    values.push_back(values_of(frames.back(), field));
    largest = std::max(largest, largest_of(values.back()));
  }
  const ShownUnit unit = shown_unit(field.name, largest);
  ContourFigure figure;
  figure.title = shown_name(field) + ": " + loaded.label;
  std::vector<ValueRange> extents;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    values[i] = scaled(std::move(values[i]), unit.factor);
    extents.push_back(robust_extent(values[i]));
    ContourPanel panel = panel_of(run, frames[i], std::move(values[i]));
    panel.title = time_text(frames[i].time);
    figure.panels.push_back(std::move(panel));
  }
  figure.scale =
      scale_of(field, unit, run.scene,
               shown.range ? shown.range : range_of_instants(extents, usual_map(field)), !shown.range);
  return figure;
}

}  // namespace

ReportPicture draw_development(const LoadedRun& loaded, const ReportField& shown, bool panels,
                               const fs::path& folder) {
  const ContourFigure figure = figure_of_frames(loaded, instants(loaded.run.series.frames.size()), shown);
  const std::string stem = "development_" + file_name(loaded.label);
  const std::string description = shown_name(shown.field) + " over time in run " + loaded.label;
  const std::string caption =
      fmt::format("How the {} develops in {}.", name_in_sentence(shown.field), loaded.label);
  if (panels) return draw(figure, folder, stem, description, caption);
  save_contours(figure, folder / (stem + ".png"));
  return {stem + ".png", description, caption};
}

std::vector<html::Instant> draw_instants(const LoadedRun& loaded, const ReportField& shown, std::size_t most,
                                         const fs::path& folder) {
  constexpr std::size_t most_particles = 1'000'000;  // of all instants: they are drawn from memory
  const std::size_t frames = loaded.run.series.frames.size();
  const std::size_t particles = std::max<std::size_t>(loaded.last.points.size() / 3, 1);
  const std::size_t count = std::min({most, frames, std::max<std::size_t>(most_particles / particles, 2)});
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * (frames - 1) / (count - 1));
  const ContourFigure figure = figure_of_frames(loaded, chosen, shown);
  std::vector<html::Instant> pictures;
  std::vector<fs::path> paths;
  for (std::size_t i = 0; i < count; ++i) {
    pictures.push_back(
        {fmt::format("frame_{}_{:03}.png", file_name(loaded.label), i + 1), figure.panels[i].title});
    paths.push_back(folder / pictures.back().file);
  }
  save_each_panel(figure, instant_width, paths);
  return pictures;
}

std::vector<html::Instant> draw_pair(const LoadedRun& a, const LoadedRun& b, const ReportField& shown,
                                     const fs::path& folder) {
  const FieldSelection& field = shown.field;
  std::vector<std::vector<double>> values = {values_of(a.last, field), values_of(b.last, field)};
  const ShownUnit unit = shown_unit(field.name, std::max(largest_of(values[0]), largest_of(values[1])));
  for (std::vector<double>& v : values) v = scaled(std::move(v), unit.factor);
  ContourFigure figure;
  figure.title = shown_name(field);
  figure.scale = scale_of(field, unit, a.run.scene,
                          shown.range ? shown.range : range_of_runs(values, usual_map(field)), !shown.range);
  std::vector<html::Instant> pictures;
  std::vector<fs::path> paths;
  for (const LoadedRun* r : {&a, &b}) {
    ContourPanel panel = panel_of(r->run, r->last, std::move(values[pictures.size()]));
    panel.title = r->label;
    panel.subtitle = panel_subtitle(r->run, r->last.time, r->label);
    figure.panels.push_back(std::move(panel));
    pictures.push_back({fmt::format("pair_{}_{}.png", file_name(b.label), pictures.size() + 1), r->label});
    paths.push_back(folder / pictures.back().file);
  }
  save_each_panel(figure, instant_width, paths);
  return pictures;
}

}  // namespace porosph::render
