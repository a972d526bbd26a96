#include "render/run/water_curves.hpp"

#include "render/run/history_lines.hpp"
#include "render/run/time_axis.hpp"

namespace porosph::render {
namespace {

/// Lines of the columns that `name` gives a label to; "" leaves a column out.
template <class Name>
Chart chart_of(const FinishedRun& run, const std::string& title, const std::string& y, Name&& name) {
  const History& history = *run.history;
  Chart chart{.title = title, .x = time_axis(), .y = {.title = y}, .series = {}, .references = {}};
  for (std::size_t c = 1; c < history.columns.size(); ++c) {
    ChartSeries line{.label = name(history.columns[c]), .x = {}, .y = {}};
    if (line.label.empty()) continue;
    for (const std::vector<double>& row : history.rows) line.x.push_back(row[0]), line.y.push_back(row[c]);
    style(line, chart.series.size());
    chart.series.push_back(std::move(line));
  }
  mark_stages(chart, run);
  show_days_if_long(chart);
  return chart;
}

std::string without(const std::string& column, const std::string& ending) {
  return column.ends_with(ending) ? column.substr(0, column.size() - ending.size()) : "";
}

}  // namespace

std::vector<Chart> water_curves(const std::vector<FinishedRun>& runs,
                                const std::vector<std::string>& labels) {
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].history) continue;
    const std::string of_run = runs.size() > 1 ? labels[i] : "";
    Chart balance = chart_of(runs[i], of_run, "water since the start [m2]", [](const std::string& column) {
      return column == "water.entered" || column == "water.left" || column == "water.gained"
                 ? column.substr(6)
                 : "";
    });
    if (balance.series.empty()) continue;
    charts.push_back(std::move(balance));
    Chart discharge = chart_of(runs[i], of_run, "discharge [m2/s]", [](const std::string& column) {
      const std::string face = without(column, ".inflow");
      return face.empty() ? without(column, ".discharge") : "into the soil at " + face;
    });
    if (!discharge.series.empty()) charts.push_back(std::move(discharge));
  }
  return charts;
}

}  // namespace porosph::render
