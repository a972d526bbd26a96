#include "render/run/stress_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/run/history_lines.hpp"
#include "render/run/time_axis.hpp"
#include "solver/case/shapes.hpp"
#include "solver/output/invariants.hpp"
#include "solver/space/place_text.hpp"

namespace porosph::render {
namespace {

constexpr double kilo = 1e-3;  // Pa to kPa
constexpr double degree = std::numbers::pi / 180;
constexpr Colour envelope_colour{90, 90, 90};

const SoilCase* soil_at(const Case& scene, const Point& start) {
  const auto found =
      std::ranges::find_if(scene.soils, [&](const SoilCase& soil) { return distance(start, soil) == 0; });
  return found == scene.soils.end() ? nullptr : &*found;
}

/// The effective stresses of a probe over time.
std::vector<Stress> stresses_of(const FinishedRun& run, const std::string& probe) {
  std::array<std::optional<ChartSeries>, 4> components;
  constexpr std::array names = {"EffectiveStress_XX", "EffectiveStress_YY", "EffectiveStress_ZZ",
                                "EffectiveStress_XY"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    components[i] = history_line(run, probe, names[i], 1);
    if (!components[i]) return {};
  }
  std::vector<Stress> stresses(components[0]->y.size());
  for (std::size_t i = 0; i < stresses.size(); ++i)
    stresses[i] = {components[0]->y[i], components[1]->y[i], components[2]->y[i], components[3]->y[i]};
  return stresses;
}

std::string strength_text(const Strength& strength, bool residual) {
  const std::string text = strength.undrained
                               ? fmt::format("c_{{u}} = {:.3g} kPa", strength.cohesion * kilo)
                               : fmt::format("c' = {:.3g} kPa, φ' = {:.3g}°", strength.cohesion * kilo,
                                             strength.friction / degree);
  return residual ? text + ", residual" : text;
}

/// offset + slope x from `low` to `high`, where it is not negative [kPa].
ChartSeries straight(const std::string& label, double offset, double slope, double low, double high,
                     LineStyle line) {
  if (slope > 0) low = std::max(low, -offset / slope);
  return {.label = label,
          .x = {low, high},
          .y = {offset + slope * low, offset + slope * high},
          .colour = envelope_colour,
          .line = line,
          .width = 1.4};
}

std::vector<ChartSeries> envelopes(const std::vector<Strength>& strengths, PathKind kind, double low,
                                   double high) {
  std::vector<ChartSeries> lines;
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    const double sine = std::sin(strengths[i].friction), cosine = std::cos(strengths[i].friction);
    const double c = strengths[i].cohesion * kilo;
    const std::string text = strength_text(strengths[i], i > 0);
    const LineStyle style = i == 0 ? LineStyle::solid : LineStyle::dotted;
    if (kind == PathKind::st) {
      lines.push_back(straight(text, c * cosine, sine, low, high, style));
    } else if (kind == PathKind::mohr) {
      lines.push_back(straight(text, c, std::tan(strengths[i].friction), low, high, style));
    } else {
      const double compression = 6 / (3 - sine), extension = 6 / (3 + sine);
      lines.push_back(straight(text, compression * c * cosine, compression * sine, low, high, style));
      lines.push_back(straight(i == 0 ? "the same in extension" : "", extension * c * cosine,
                               extension * sine, low, high,
                               i == 0 ? LineStyle::dashed : LineStyle::dash_dotted));
    }
  }
  return lines;
}

ChartSeries path_of(const std::vector<Stress>& stresses, PathKind kind) {
  ChartSeries line;
  for (const Stress& stress : stresses) {
    const StressPoint point = stress_point(stress);
    line.x.push_back(kilo * (kind == PathKind::pq ? point.p : point.s));
    line.y.push_back(kilo * (kind == PathKind::pq ? point.q : point.t));
  }
  return line;
}

/// The upper half.
ChartSeries circle_of(const Stress& stress) {
  const StressPoint point = stress_point(stress);
  ChartSeries line;
  constexpr int steps = 90;
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi * i / steps;
    line.x.push_back(kilo * (point.s + point.t * std::cos(angle)));
    line.y.push_back(kilo * point.t * std::sin(angle));
  }
  return line;
}

ChartSeries level_plane(const Stress& stress, std::size_t run) {
  return {.label = "",
          .x = {-kilo * stress.yy},
          .y = {kilo * std::abs(stress.xy)},
          .colour = series_colour(run),
          .line = LineStyle::none,
          .marker = Marker::diamond};
}

Chart empty_chart(PathKind kind, const ProbeCase& probe) {
  const std::string place = fmt::format("At {} {} m", probe.name, place_text(probe.position));
  switch (kind) {
    case PathKind::pq:
      return {.title = place + ": q over p'",
              .x = {.title = "p' [kPa]"},
              .y = {.title = "q [kPa]"},
              .series = {},
              .references = {}};
    case PathKind::st:
      return {.title = place + ": t over s'",
              .x = {.title = "s' [kPa]"},
              .y = {.title = "t [kPa]"},
              .series = {},
              .references = {}};
    case PathKind::mohr:
      break;
  }
  return {.title = place + ": Mohr's circle at the end",
          .x = {.title = "σ' [kPa], compression positive"},
          .y = {.title = "τ [kPa]"},
          .series = {},
          .references = {},
          .to_scale = true};
}

/// From zero, or from tension, to a little beyond all that the lines have.
std::pair<double, double> span_of(const std::vector<ChartSeries>& lines,
                                  std::vector<double> ChartSeries::*axis) {
  double low = 0, high = 0;
  for (const ChartSeries& line : lines)
    for (const double value : line.*axis)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  const double air = 0.08 * std::max(high - low, 1e-6);
  return {low < 0 ? low - air : 0, high + air};
}

/// The strengths of the first run, and of those that have other ones, in their own colours.
std::vector<ChartSeries> strengths_of(const std::vector<FinishedRun>& runs,
                                      const std::vector<std::string>& labels, const Point& start,
                                      PathKind kind, double low, double high) {
  std::vector<ChartSeries> lines;
  std::vector<std::vector<Strength>> drawn;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].scene) continue;
    std::vector<Strength> strengths = strength_at(*runs[i].scene, start);
    if (strengths.empty() || std::ranges::find(drawn, strengths) != drawn.end()) continue;
    for (ChartSeries& line : envelopes(strengths, kind, low, high)) {
      if (!drawn.empty()) {
        line.colour = series_colour(i);
        if (!line.label.empty()) line.label += ", " + labels[i];
      }
      lines.push_back(std::move(line));
    }
    drawn.push_back(std::move(strengths));
  }
  return lines;
}

std::optional<Chart> chart_at(const std::vector<FinishedRun>& runs, const std::vector<std::string>& labels,
                              const ProbeCase& probe, PathKind kind) {
  Chart chart = empty_chart(kind, probe);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<Stress> stresses = stresses_of(runs[i], probe.name);
    if (stresses.empty()) continue;
    const bool mohr = kind == PathKind::mohr;
    ChartSeries line = mohr ? circle_of(stresses.back()) : path_of(stresses, kind);
    line.label = labels[i];
    style(line, i);
    if (!mohr) {
      mark_end(line, runs[i]);
      if (line.end == LineEnd::plain) line.end = LineEnd::stopped;
    }
    chart.series.push_back(std::move(line));
    if (mohr) chart.series.push_back(level_plane(stresses.back(), i));
  }
  if (chart.series.empty()) return std::nullopt;
  const auto [left, right] = span_of(chart.series, &ChartSeries::x);
  const double top = span_of(chart.series, &ChartSeries::y).second;
  chart.x.range = ValueRange{left, right};
  double highest = top;
  for (ChartSeries& line : strengths_of(runs, labels, probe.position, kind, left, right)) {
    highest = std::max(highest, std::min(line.y.back(), 2 * top));
    chart.series.push_back(std::move(line));
  }
  chart.y.range = ValueRange{0, highest};
  return chart;
}

}  // namespace

StressPoint stress_point(const Stress& effective) {
  const std::array<double, 3> principal = principal_stresses(effective);
  return {.p = -effective.mean(),
          .q = von_mises_stress(effective),
          .s = -(principal[0] + principal[2]) / 2,
          .t = (principal[0] - principal[2]) / 2};
}

std::vector<Strength> strength_at(const Case& scene, const Point& start) {
  const SoilCase* soil = soil_at(scene, start);
  if (soil == nullptr || soil->law == LawKind::elastic) return {};
  const StrengthCase& c = soil->strength;
  const bool softens = c.softening != SofteningKind::none;
  if (soil->law == LawKind::tresca) {
    double top = -never;
    for (const Point& p : soil->polygon) top = std::max(top, p.y());
    const double depth = std::max(0.0, (c.level < never ? c.level : top) - start.y());
    const double strength = c.undrained_strength + c.growth * depth;
    std::vector<Strength> all = {{strength, 0, true}};
    if (softens) all.push_back({strength / c.sensitivity, 0, true});
    return all;
  }
  std::vector<Strength> all = {{c.cohesion, c.friction_angle * degree, false}};
  if (softens) all.push_back({c.residual_cohesion, c.residual_friction_angle * degree, false});
  return all;
}

std::vector<Chart> stress_paths(const std::vector<FinishedRun>& runs, const std::vector<std::string>& labels,
                                PathKind kind) {
  std::vector<Chart> charts;
  if (!runs.front().scene) return charts;
  for (const ProbeCase& probe : runs.front().scene->probes)
    if (auto chart = chart_at(runs, labels, probe, kind)) charts.push_back(std::move(*chart));
  return charts;
}

std::vector<Chart> settlement_curves(const std::vector<FinishedRun>& runs,
                                     const std::vector<std::string>& labels) {
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].scene) continue;
    Chart chart{.title = runs.size() > 1 ? labels[i] : "",
                .x = time_axis(),
                .y = {.title = "settlement [mm]"},
                .series = {},
                .references = {}};
    chart.x.logarithmic = runs[i].scene->water.mode == WaterMode::coupled;
    for (const ProbeCase& probe : runs[i].scene->probes) {
      auto line = history_line(runs[i], probe.name, "Displacement_Y", -1e3);
      if (!line) continue;
      line->label = probe.name;
      style(*line, chart.series.size());
      mark_end(*line, runs[i]);
      chart.series.push_back(std::move(*line));
    }
    if (chart.series.empty()) continue;
    mark_stages(chart, runs[i]);
    show_days_if_long(chart);
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace porosph::render
