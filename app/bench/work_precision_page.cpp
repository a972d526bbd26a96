#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/bench/csv.hpp"
#include "app/bench/work_precision.hpp"
#include "render/chart.hpp"

namespace porosph::bench {

using namespace render;

namespace {

using Rows = std::vector<std::vector<std::string>>;

void write_table(const WorkPrecision& work, const Bench& bench) {
  Rows rows = {{"scene", "form", "strategy", "spacing", "particles_or_unknowns", "steps", "ending", "error",
                "seconds", "seconds_low", "seconds_high", "settled", "settled_low", "settled_high"}};
  for (const WorkPoint& p : work.points)
    rows.push_back({p.scene, p.form, p.strategy, digits(p.spacing), std::to_string(p.particles),
                    std::to_string(p.steps), p.ending, digits(p.error), digits(p.seconds.median),
                    digits(p.seconds.low), digits(p.seconds.high), digits(p.settled.median),
                    digits(p.settled.low), digits(p.settled.high)});
  write_csv(bench.options().out / "work_precision.csv", rows);
}

/// What happens once in a list, in the order of first appearance.
template <class Of>
std::vector<std::string> distinct(const std::vector<WorkPoint>& points, Of of) {
  std::vector<std::string> all;
  for (const WorkPoint& p : points)
    if (std::find(all.begin(), all.end(), of(p)) == all.end()) all.push_back(of(p));
  return all;
}

/// `line`: number of the form with its strategy, whose colour is the same in all charts.
ChartSeries series_of(std::vector<WorkPoint> points, std::size_t line, std::size_t strategy) {
  static constexpr LineStyle lines[] = {LineStyle::dash_dotted, LineStyle::dashed, LineStyle::solid,
                                        LineStyle::dotted};
  static constexpr Marker markers[] = {Marker::diamond, Marker::square, Marker::circle, Marker::triangle};
  std::sort(points.begin(), points.end(),
            [](const WorkPoint& a, const WorkPoint& b) { return a.spacing > b.spacing; });
  ChartSeries series{.label = points.front().form + ": " + points.front().strategy, .x = {}, .y = {}};
  for (const WorkPoint& p : points) series.x.push_back(p.work().median), series.y.push_back(100 * p.error);
  series.colour = series_colour(line);
  series.line = lines[strategy % 4];
  series.marker = markers[strategy % 4];
  return series;
}

/// Room for the values on a logarithmic axis, a decade at least, so that it has labels.
ValueRange range_of(const std::vector<ChartSeries>& all, std::vector<double> ChartSeries::*coordinate) {
  double low = never, high = 0;
  for (const ChartSeries& series : all)
    for (double value : series.*coordinate)
      if (value > 0 && value < never) low = std::min(low, value), high = std::max(high, value);
  if (high == 0) return {0.1, 1};
  const double margin = std::max(1.4, std::sqrt(10 * low / high));
  return {low / margin, high * margin};
}

Chart chart_of(const WorkPrecision& work, const std::string& scene) {
  const auto forms = distinct(work.points, [](const WorkPoint& p) { return p.form; });
  const auto strategies = distinct(work.points, [](const WorkPoint& p) { return p.strategy; });
  Chart chart{.title = scene,
              .x = {.title = "run time on one core [s]", .logarithmic = true},
              .y = {.title = "error of σ'yy [%]", .logarithmic = true},
              .series = {},
              .references = {}};
  const auto lines = distinct(work.points, [](const WorkPoint& p) { return p.form + p.strategy; });
  for (const std::string& form : forms)
    for (std::size_t s = 0; s < strategies.size(); ++s) {
      std::vector<WorkPoint> points;
      for (const WorkPoint& p : work.points)
        if (p.scene == scene && p.form == form && p.strategy == strategies[s] && p.ending != "unstable")
          points.push_back(p);
      const auto line = std::find(lines.begin(), lines.end(), form + strategies[s]) - lines.begin();
      if (!points.empty()) chart.series.push_back(series_of(points, static_cast<std::size_t>(line), s));
    }
  chart.x.range = range_of(chart.series, &ChartSeries::x);
  chart.y.range = range_of(chart.series, &ChartSeries::y);
  return chart;
}

void draw(const WorkPrecision& work, const std::vector<std::string>& scenes, const Bench& bench) {
  ChartFigure figure{.title = "", .charts = {}, .columns = 1, .width = 1100, .height = 0};
  for (const std::string& scene : scenes) figure.charts.push_back(chart_of(work, scene));
  figure.height = 420 * static_cast<int>(scenes.size());
  save_charts(figure, bench.options().out / "work_precision.png");
}

std::string percent(double error) {
  return std::isfinite(error) ? fmt::format("{:.3g} %", 100 * error) : "–";
}

StudyTable table_of(const WorkPrecision& work, const std::string& scene) {
  Rows rows = {{"Form, strategy", "Spacing [m]", "Particles", "Steps", "Ending", "Error of σ'yy",
                "Settled [s]", "Run time [s]"}};
  for (const WorkPoint& p : work.points)
    if (p.scene == scene)
      rows.push_back({p.form + ", " + p.strategy, fmt::format("{:.3g}", p.spacing),
                      std::to_string(p.particles), p.steps > 0 ? std::to_string(p.steps) : "–", p.ending,
                      percent(p.error), fmt::format("{:.3g}", p.settled.median), text(p.seconds)});
  return {.caption = "The " + scene, .rows = rows};
}

}  // namespace

StudySection show_work_precision(const WorkPrecision& work, const Bench& bench) {
  const auto scenes = distinct(work.points, [](const WorkPoint& p) { return p.scene; });
  write_table(work, bench);
  draw(work, scenes, bench);
  StudySection section{
      .heading = "Run time against error",
      .paragraphs =
          {"Error: relative L2 norm of the vertical effective stress at the end of the run, against the "
           "exact finite-strain column, or, for the embankment, against finite elements (without 1 m "
           "around the toes and 0.5 m around the crest's corners). Finite elements assume small strain, "
           "the particles do not: in the embankment that difference stays however fine the particles are; "
           "the stiff embankment, of a soil a thousand times as stiff, is without it. The finite elements' "
           "own error is against converged small-strain probes, in the column against the exact finite "
           "strain.",
           "Time: of one core, without what looking at the error takes. A run counts until it stops by "
           "itself at equilibrium; one that has no such stop only until its error came within 5 % of its "
           "last value and stayed there. In the table of finite elements the spacing is the length of an "
           "edge, and particles are unknowns. The plain loops with C = 0.2, ξ = 0.002 are the paper's "
           "procedure; the consistent form with them is the foundation and the embankment as shipped. The "
           "fast cases are shipped, too, made to come to rest soonest. Run times: the median of several "
           "runs, which take turns, and half the range from the fastest to the slowest."},
      .tables = {},
      .pictures = {{.file = "work_precision.png",
                    .description = "Error over run time, one chart per scene, logarithmic axes",
                    .caption = "Error against run time; each line is one form and strategy, coarse to fine "
                               "particles from left to right"}}};
  for (const std::string& scene : scenes) section.tables.push_back(table_of(work, scene));
  return section;
}

}  // namespace porosph::bench
