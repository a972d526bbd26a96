#include "render/run/history_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "render/run/shown_field.hpp"
#include "render/run/time_axis.hpp"
#include "solver/reference/exact/dynamic_column.hpp"
#include "solver/reference/exact/finite_strain_column.hpp"
#include "solver/run/reference_errors.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::render {

std::optional<ChartSeries> history_line(const FinishedRun& run, const std::string& probe,
                                        const std::string& quantity, double factor) {
  if (!run.history) return std::nullopt;
  const auto& columns = run.history->columns;
  const auto found = std::find(columns.begin(), columns.end(), probe + "." + quantity);
  if (found == columns.end()) return std::nullopt;
  const auto column = static_cast<std::size_t>(found - columns.begin());
  ChartSeries series;
  for (const std::vector<double>& row : run.history->rows) {
    series.x.push_back(row[0]);
    series.y.push_back(row[column] * factor);
  }
  return series;
}

std::optional<double> theory_at(const Case& scene, const ProbeCase& probe, const std::string& quantity) {
  if (scene.reference != Reference::column) return std::nullopt;
  const ReferenceColumn reference = reference_column(scene);
  const FiniteStrainColumn exact(reference.column);
  const double height = probe.position.y() - reference.bottom;
  if (quantity == "EffectiveStress_YY") return exact.vertical_stress(height);
  if (quantity == "EffectiveStress_XX" || quantity == "EffectiveStress_ZZ")
    return exact.lateral_stress(height);
  if (quantity == "Displacement_Y") return exact.displacement(height);
  return std::nullopt;
}

std::optional<ChartSeries> exact_vibration(const Case& scene, const ProbeCase& probe, double factor) {
  const LoadingCase& loading = scene.loading;
  if (scene.reference != Reference::column || loading.damping != 0 || loading.adaptive_damping ||
      loading.k0_stress || !loading.gravity_applied)
    return std::nullopt;
  const ReferenceColumn reference = reference_column(scene);
  const Column& c = reference.column;
  if (c.water_level >= 0 && c.water_level < c.height) return std::nullopt;  // two unit weights
  const bool wet = c.water_level >= c.height;
  const double weight = wet ? c.unit_weight_saturated : c.unit_weight_unsaturated;
  const DynamicColumn exact{.height = c.height,
                            .modulus = c.constrained_modulus(),
                            .density = weight / loading.gravity,
                            .unit_weight = wet ? weight - c.unit_weight_water : weight};
  ChartSeries series{.label = "exact, undamped", .x = {}, .y = {}, .colour = Colour{90, 90, 90}, .width = 1};
  constexpr int points = 2000;
  for (int i = 0; i <= points; ++i) {
    series.x.push_back(scene.time.end * i / points);
    series.y.push_back(factor *
                       exact.vertical_stress(probe.position.y() - reference.bottom, series.x.back()));
  }
  return series;
}

void mark_end(ChartSeries& series, const FinishedRun& run) {
  if (!run.summary) return;
  const RunStatus status = run.summary->status;
  if (status == RunStatus::completed) return;
  series.end = status == RunStatus::equilibrium ? LineEnd::stopped : LineEnd::broken;
  if (status == RunStatus::unstable)
    series.label += fmt::format(", unstable at {}", short_time(run.summary->time));
  if (status == RunStatus::interrupted)
    series.label += fmt::format(", interrupted at {}", short_time(run.summary->time));
}

void mark_stages(Chart& chart, const FinishedRun& run) {
  if (!run.summary) return;
  const auto& stages = run.summary->stages;
  for (std::size_t i = 1; i < stages.size(); ++i) chart.uprights.push_back({stages[i].name, stages[i].start});
}

void style(ChartSeries& series, std::size_t run) {
  constexpr std::array lines = {LineStyle::solid, LineStyle::dashed, LineStyle::dash_dotted,
                                LineStyle::dotted};
  series.colour = series_colour(run);
  series.line = lines[run % lines.size()];
}

std::vector<Chart> stress_histories(const std::vector<FinishedRun>& runs,
                                    const std::vector<std::string>& labels) {
  const FieldSelection field{"EffectiveStress", "YY"};
  const ShownUnit unit = shown_unit(field.name, 0);
  std::vector<Chart> charts;
  if (!runs.front().scene) return charts;
  for (const ProbeCase& probe : runs.front().scene->probes) {
    Chart chart{.title = fmt::format("At {} {} m", probe.name, place_text(probe.position)),
                .x = time_axis(),
                .y = {.title = shown_label(field, unit)},
                .series = {},
                .references = {}};
    std::optional<ChartSeries> exact;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      auto line = history_line(runs[i], probe.name, field.text(), unit.factor);
      if (!line) continue;
      line->label = labels[i];
      style(*line, i);
      mark_end(*line, runs[i]);
      chart.series.push_back(std::move(*line));
      if (!exact && runs[i].scene) exact = exact_vibration(*runs[i].scene, probe, unit.factor);
    }
    if (chart.series.empty()) continue;
    if (exact) chart.series.insert(chart.series.begin(), std::move(*exact));
    if (const auto theory = theory_at(*runs.front().scene, probe, field.text()))
      chart.references.push_back({.label = "theory, at rest", .y = *theory * unit.factor});
    if (runs.size() == 1) mark_stages(chart, runs.front());
    show_days_if_long(chart);
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace porosph::render
