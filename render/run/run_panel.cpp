#include "render/run/run_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/run/material_points.hpp"
#include "render/run/particle_cells.hpp"
#include "render/run/shown_field.hpp"
#include "solver/case/case_file.hpp"
#include "solver/model/water.hpp"

namespace porosph {
namespace {

bool has(const Frame& frame, const std::string& name) {
  return std::any_of(frame.fields.begin(), frame.fields.end(), [&](const auto& f) { return f.name == name; });
}

std::vector<Point> positions_of(const Frame& frame) {
  std::vector<Point> out(frame.points.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {frame.points[3 * i], frame.points[3 * i + 1]};
  return out;
}

constexpr double overlap = 1.03;  // so that soil that stretches a little shows no gaps

/// Median distance from a few particles to their nearest.
double usual_distance(const std::vector<Point>& positions) {
  std::vector<double> nearest;
  const std::size_t stride = std::max<std::size_t>(1, positions.size() / 50);
  for (std::size_t i = 0; i < positions.size(); i += stride) {
    double least = never;
    for (std::size_t j = 0; j < positions.size(); ++j)
      if (j != i) least = std::min(least, (positions[j] - positions[i]).squaredNorm());
    if (std::isfinite(least) && least > 0) nearest.push_back(std::sqrt(least));
  }
  if (nearest.empty()) return 1;
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<long>(nearest.size() / 2), nearest.end());
  return nearest[nearest.size() / 2];
}

}  // namespace

namespace {

/// With the water level of that time [s].
Case scene_at(Case scene, double time) {
  scene.water = at_rest_from(scene.water, time);
  return scene;
}

}  // namespace

Scenery scenery_of(const Case& scene) {
  Scenery scenery{
      .soils = {}, .water = scene.water.stretches, .boundaries = scene.boundaries, .probes = scene.probes};
  for (const SoilCase& soil : scene.soils) scenery.soils.push_back({soil.polygon, soil.holes});
  return scenery;
}

std::vector<double> particle_sizes(const FinishedRun& run, const Frame& frame) {
  if (run.scene) return {overlap * run.scene->particles.spacing};
  if (!has(frame, "Mass") || !has(frame, "Density")) return {usual_distance(positions_of(frame))};
  std::vector<double> sizes = values_of(frame, {"Mass", ""});
  const std::vector<double> densities = values_of(frame, {"Density", ""});
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::sqrt(sizes[i] / densities[i]);
  return sizes;
}

std::vector<Polygon> drawn_cells(const Case& scene, const std::vector<Point>& starts) {
  std::vector<Polygon> cells = particle_cells(scene, starts);
  for (Polygon& cell : cells)
    for (Point& corner : cell) corner *= overlap;
  return cells;
}

ContourPanel panel_of(const FinishedRun& run, const Frame& frame, std::vector<double> values,
                      double deformation) {
  ContourPanel panel;
  panel.particles.positions = positions_of(frame);
  panel.particles.values = std::move(values);
  panel.particles.sizes = particle_sizes(run, frame);
  if (run.scene && has(frame, "Displacement"))
    panel.particles.cells = drawn_cells(*run.scene, starts_of(frame));
  if (deformation != 1) {
    if (!has(frame, "Displacement"))
      throw std::runtime_error(
          "drawing the deformation needs the field Displacement, which the series does not have");
    const auto x = values_of(frame, {"Displacement", "X"}), y = values_of(frame, {"Displacement", "Y"});
    for (std::size_t i = 0; i < x.size(); ++i) panel.particles.displacements.push_back({x[i], y[i]});
    panel.particles.displacement_factor = deformation - 1;  // the positions hold it once
  }
  if (run.scene) panel.scenery = scenery_of(scene_at(*run.scene, frame.time));
  return panel;
}

ValueRange shared_range(const std::vector<std::vector<double>>& values, ColourMap map) {
  std::vector<double> ends;
  for (const auto& v : values)
    if (const ValueRange r = finite_extent(v); r.low <= r.high) ends.insert(ends.end(), {r.low, r.high});
  return is_diverging(map) ? centred_range(finite_extent(ends)) : rounded_range(finite_extent(ends));
}

std::string time_text(double time) { return fmt::format("t = {:.3g} s", time); }

std::string formulation_text(const FinishedRun& run) {
  if (!run.scene) return "";
  const FormulationCase& f = run.scene->formulation;
  return std::string(motion_name(f.motion)) + (f.kernel_correction ? "" : ", without kernel correction") +
         (run.scene->loading.damping > 0 || run.scene->loading.adaptive_damping ? "" : ", undamped");
}

}  // namespace porosph
