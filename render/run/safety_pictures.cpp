#include "render/run/safety_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/chart.hpp"
#include "render/run/run_panel.hpp"
#include "solver/model/model.hpp"
#include "solver/output/fields.hpp"

namespace porosph::render {
namespace {

constexpr std::array<Colour, 3> surface_colours{Colour{215, 48, 39}, Colour{20, 20, 20},
                                                Colour{150, 60, 190}};

std::string label_of(const NamedSurface& s) { return fmt::format("{}: {:.3f}", s.name, s.surface.factor); }

Scenery scenery_with_surfaces(const Case& scene, const SafetyAnswer& answer) {
  Scenery scenery = scenery_at(scene, scene.flow ? scene.flow->time : scene.time.end);
  scenery.probes.clear();
  const std::vector<NamedSurface> surfaces = slip_surfaces(answer);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    scenery.lines.push_back({surfaces[i].surface.points, label_of(surfaces[i]), surface_colours[i]});
  return scenery;
}

/// Particles where they were at the start, with one value each.
ContourPanel panel_at_start(const Case& scene, const Particles& p, std::vector<double> values) {
  ContourPanel panel;
  std::vector<Point> starts;
  for (std::size_t i = 0; i < p.size(); ++i) starts.push_back(p.start[i]);
  panel.particles.positions = starts;
  panel.particles.values = std::move(values);
  panel.particles.sizes = {scene.particles.spacing};
  panel.particles.cells = drawn_cells(scene, starts);
  return panel;
}

std::vector<double> values_of_field(const Frame& frame, const std::string& name) {
  for (const FrameField& field : frame.fields)
    if (field.name == name) return std::get<std::vector<double>>(field.values);
  return {};
}

/// Every value below that which all but 1 % have: a few particles at corners are strained far more.
double upper_end(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(0.99 * static_cast<double>(values.size() - 1))];
}

/// Plastic strain of the trial alone.
ContourFigure strain_figure(const Case& scene, const StrengthReduction& found) {
  Simulation& failed = *found.mechanism;
  std::vector<double> strain = values_of_field(make_frame(failed, {"PlasticStrain"}), "PlasticStrain");
  for (std::size_t i = 0; i < found.strain_before.size(); ++i) strain[i] -= found.strain_before[i];
  const double end = std::max(upper_end(strain), 1e-12);
  ContourFigure figure{.title = scene.title, .panels = {}, .scale = {.label = "plastic strain [-]"}};
  figure.scale.range = ValueRange{0, end};
  figure.panels.push_back(panel_at_start(scene, failed.model().particles, std::move(strain)));
  return figure;
}

ContourFigure soil_figure(const Case& scene) {
  const Model model = build_model(scene);
  std::vector<double> soil(model.particles.size());
  for (std::size_t i = 0; i < soil.size(); ++i) soil[i] = model.particles.soil[i];
  ContourFigure figure{.title = scene.title, .panels = {}, .scale = {.label = "soil"}};
  for (const SoilCase& s : scene.soils) figure.scale.categories.push_back(s.name);
  figure.panels.push_back(panel_at_start(scene, model.particles, std::move(soil)));
  return figure;
}

ChartSeries vertical_line(const NamedSurface& s, double top, Colour colour) {
  return {.label = label_of(s),
          .x = {s.surface.factor, s.surface.factor},
          .y = {0, top},
          .colour = colour,
          .line = LineStyle::dashed};
}

}  // namespace

void save_safety_curve(const SafetyAnswer& answer, const std::filesystem::path& path) {
  const StrengthReduction& found = *answer.particles;
  ChartSeries stable{.label = "at rest", .x = {}, .y = {}, .marker = Marker::circle};
  ChartSeries failed{.label = "failed", .x = {}, .y = {}, .line = LineStyle::none, .marker = Marker::square};
  double top = 0;
  for (const StrengthTrial& t : found.trials) {
    const double ratio = t.displacement / found.at_rest;
    ChartSeries& series = t.stable() ? stable : failed;
    series.x.push_back(t.factor), series.y.push_back(std::min(ratio, 6.0));
    top = std::max(top, series.y.back());
  }
  Chart chart{.title = found.fails_at < never && found.stable_at > 0
                           ? fmt::format("factor of safety between {:.3f} and {:.3f}", found.stable_at,
                                         found.fails_at)
                           : std::string("factor of safety: no bracket"),
              .x = {.title = "factor that strength is divided by [-]"},
              .y = {.title = "largest displacement / that at rest [-]"},
              .series = {stable, failed},
              .references = {}};
  const std::vector<NamedSurface> surfaces = slip_surfaces(answer);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    chart.series.push_back(vertical_line(surfaces[i], top, surface_colours[i]));
  save_charts({.title = answer.title, .charts = {std::move(chart)}}, path);
}

void save_safety_over_setting(const SafetyCurve& curve, const std::filesystem::path& path) {
  ChartSeries particles{
      .label = "particles, middle of the bracket", .x = {}, .y = {}, .marker = Marker::circle};
  std::vector<ChartSeries> of_surfaces;
  for (std::size_t i = 0; i < curve.values.size(); ++i) {
    const SafetyAnswer& answer = curve.answers[i];
    if (answer.particles && answer.particles->stable_at > 0 && answer.particles->fails_at < never) {
      particles.x.push_back(curve.values[i]);
      particles.y.push_back((answer.particles->stable_at + answer.particles->fails_at) / 2);
    }
    for (const NamedSurface& s : slip_surfaces(answer)) {
      auto series = std::ranges::find(of_surfaces, s.name, &ChartSeries::label);
      if (series == of_surfaces.end())
        series = of_surfaces.insert(series,
                                    {.label = s.name,
                                     .x = {},
                                     .y = {},
                                     .colour = surface_colours[of_surfaces.size() % surface_colours.size()],
                                     .line = LineStyle::dashed});
      series->x.push_back(curve.values[i]), series->y.push_back(s.surface.factor);
    }
  }
  Chart chart{.title = "",
              .x = {.title = fmt::format("{} [{}]", curve.key, curve.unit)},
              .y = {.title = "factor of safety [-]"},
              .series = {},
              .references = {}};
  if (!particles.x.empty()) chart.series.push_back(std::move(particles));
  for (ChartSeries& series : of_surfaces) chart.series.push_back(std::move(series));
  save_charts({.title = curve.title, .charts = {std::move(chart)}}, path);
}

void save_mechanism(const Case& scene, const SafetyAnswer& answer, const std::filesystem::path& path) {
  const bool failed = answer.particles && answer.particles->mechanism;
  ContourFigure figure = failed ? strain_figure(scene, *answer.particles) : soil_figure(scene);
  ContourPanel& panel = figure.panels.front();
  panel.scenery = scenery_with_surfaces(scene, answer);
  if (failed)
    panel.title = fmt::format("Mechanism at strength / {:.3f}", answer.particles->fails_at);
  else
    panel.title = "Slip surfaces";
  save_contours(figure, path);
}

}  // namespace porosph::render
