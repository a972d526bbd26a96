#include "render/run/run_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/run/particle_cells.hpp"
#include "render/run/shown_field.hpp"
#include "render/run/soil_mesh.hpp"
#include "render/run/water_around.hpp"
#include "solver/case/case_file.hpp"
#include "solver/water/flow/face_conditions.hpp"
#include "solver/water/standing_water.hpp"
#include "vtk_io/finished_run/material_points.hpp"
#include "vtk_io/finished_run/stage_scene.hpp"
#include "vtk_io/particle_series.hpp"
#include "vtk_io/sheets_vtp.hpp"

namespace porosph::render {
namespace {

std::vector<Point> positions_of(const Frame& frame) {
  std::vector<Point> out(frame.points.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {frame.points[3 * i], frame.points[3 * i + 1]};
  return out;
}

constexpr double overlap = 1.03;                     // so that soil that stretches a little shows no gaps
constexpr std::size_t most_deformed_cells = 50'000;  // more are too small for their shape to be seen

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

/// With corners no further apart than `spacing`, so that it can bend.
Polygon subdivided(const Polygon& ring, double spacing) {
  Polygon out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point along = ring[(i + 1) % ring.size()] - ring[i];
    const double pieces = std::clamp(std::ceil(along.norm() / spacing), 1., 10'000.);
    for (int k = 0; k < static_cast<int>(pieces); ++k) out.push_back(ring[i] + k / pieces * along);
  }
  return out;
}

bool seeps(const Case& scene) {
  return scene.water.mode == WaterMode::steady || scene.water.mode == WaterMode::transient;
}

/// With the water level of that time [s].
Case scene_at(Case scene, double time) {
  scene.water = at_rest_from(scene.water, time);
  for (HydraulicFaceCase& face : scene.water.faces) face = face_now(face, time);
  return scene;
}

}  // namespace

Scenery scenery_of(const Case& scene) {
  Scenery scenery{
      .soils = {}, .water = scene.water.stretches, .boundaries = scene.boundaries, .probes = scene.probes};
  scenery.loads = scene.loads;
  scenery.footings = scene.footings;
  for (const SheetCase& sheet : scene.sheets) scenery.sheets.push_back({{sheet.from, sheet.to}, {}});
  if (seeps(scene)) scenery.water = water_beside_faces(scene);
  for (const SoilCase& soil : scene.soils) scenery.soils.push_back({soil.polygon, soil.holes});
  return scenery;
}

Scenery scenery_at(const Case& scene, double time) { return scenery_of(scene_at(scene, time)); }

std::vector<double> particle_sizes(const FinishedRun& run, const Frame& frame) {
  if (run.scene) return {overlap * run.scene->particles.spacing};
  if (!has_field(frame, "Mass") || !has_field(frame, "Density")) return {usual_distance(positions_of(frame))};
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

/// Plates go as the soil at their middle: they are rigid.
void move_footings(ContourPanel& panel, const Case& scene, const std::vector<Point>& starts,
                   const std::vector<Point>& displacements, double factor) {
  if (panel.scenery.footings.empty()) return;
  std::vector<Point> middles;
  for (const FootingCase& f : panel.scenery.footings) middles.push_back((f.from + f.to) / 2);
  std::vector<double> u_x, u_y;
  for (const Point& u : displacements) u_x.push_back(u.x()), u_y.push_back(u.y());
  const Sampler sample(middles, starts, scene.smoothing_length());
  const std::vector<double> x = sample(u_x), y = sample(u_y);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    FootingCase& footing = panel.scenery.footings[i];
    const Point along = (footing.to - footing.from).normalized(), across(-along.y(), along.x());
    const Point way = factor * across.dot(Point(x[i], y[i])) * across;
    if (way.allFinite()) footing.from += way, footing.to += way;
  }
}

/// Where they are at that time, with what they carry, if the run has written it.
void take_sheets(ContourPanel& panel, const FinishedRun& run, double time, double deformation) {
  if (panel.scenery.sheets.empty()) return;
  const auto frame = std::ranges::find(run.series.frames, time, &SeriesFrame::time);
  if (frame == run.series.frames.end()) return;
  const std::filesystem::path file = run.series.folder / sheets_file(*frame);
  if (!std::filesystem::exists(file)) return;
  panel.scenery.sheets.clear();
  for (const SheetFrame& sheet : read_sheets_vtp(file)) {
    DrawnSheet& drawn = panel.scenery.sheets.emplace_back();
    for (const SheetFrame::Node& node : sheet.nodes) {
      drawn.points.emplace_back(node.x + deformation * node.u_x, node.y + deformation * node.u_y);
      drawn.moments.push_back(node.moment);
    }
  }
}

void deform_surroundings(ContourPanel& panel, const Case& scene, const std::vector<Point>& starts,
                         const std::vector<Point>& displacements, double factor) {
  std::vector<double> u_x, u_y;
  for (const Point& u : displacements) u_x.push_back(u.x()), u_y.push_back(u.y());
  const auto moved = [&](const std::vector<Point>& points) {
    const Sampler sample(points, starts, scene.smoothing_length());
    const std::vector<double> x = sample(u_x), y = sample(u_y);
    std::vector<Point> out = points;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (std::isfinite(x[i]) && std::isfinite(y[i])) out[i] += factor * Point(x[i], y[i]);
    return out;
  };
  for (SoilOutline& soil : panel.scenery.soils) {
    soil.polygon = moved(subdivided(soil.polygon, scene.particles.spacing));
    for (Polygon& hole : soil.holes) hole = moved(subdivided(hole, scene.particles.spacing));
  }
  std::vector<Point> probes;
  for (const ProbeCase& probe : panel.scenery.probes) probes.push_back(probe.position);
  probes = moved(probes);
  for (std::size_t i = 0; i < probes.size(); ++i) panel.scenery.probes[i].position = probes[i];

  std::vector<Polygon>& cells = panel.particles.cells;
  if (starts.size() > most_deformed_cells) return;
  cells.resize(starts.size());
  const double half = 0.5 * overlap * scene.particles.spacing;
  std::vector<Point> corners;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].empty()) cells[i] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    for (const Point& corner : cells[i]) corners.push_back(starts[i] + corner);
  }
  corners = moved(corners);
  std::size_t next = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (Point& corner : cells[i]) corner = corners[next++] - (starts[i] + factor * displacements[i]);
}

void add_smooth_field(ContourPanel& panel, const Case* scene, const std::vector<Point>& starts,
                      const std::vector<Point>& positions, const std::vector<Point>& drawn) {
  const double spacing = scene != nullptr ? scene->particles.spacing : usual_distance(starts);
  const SoilMesh mesh(scene, starts, positions, spacing);
  panel.smooth = {.points = mesh.at_corners(drawn, starts),
                  .values = mesh.at_corners(panel.particles.values),
                  .triangles = mesh.triangles(),
                  .uncovered = mesh.uncovered()};
}

ContourPanel panel_of(const FinishedRun& run, const Frame& frame, std::vector<double> values,
                      double deformation, FieldStyle style) {
  ContourPanel panel;
  panel.particles.positions = positions_of(frame);
  panel.particles.values = std::move(values);
  panel.particles.sizes = particle_sizes(run, frame);
  const bool knows_starts = has_field(frame, "Displacement");
  const std::optional<Case> then = run.scene ? std::optional(scene_during(run, frame.time)) : std::nullopt;
  const Case* scene = then && knows_starts ? &*then : nullptr;
  const std::vector<Point> positions = panel.particles.positions,
                           starts = knows_starts ? starts_of(frame) : positions;
  if (scene != nullptr) panel.particles.cells = drawn_cells(*scene, starts);
  if (then) panel.scenery = scenery_of(scene_at(*then, frame.time));
  if (run.scene && seeps(*run.scene) && has_field(frame, "PressureHead"))
    panel.scenery.water_table = water_table(panel.particles.positions, values_of(frame, {"PressureHead", ""}),
                                            run.scene->particles.spacing);
  if (deformation != 1 && !knows_starts)
    throw std::runtime_error(
        "drawing the deformation needs the field Displacement, which the series does not have");
  std::vector<Point> drawn = positions, displacements;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    displacements.push_back(positions[i] - starts[i]);
    drawn[i] += (deformation - 1) * displacements[i];
  }
  if (style != FieldStyle::particles) add_smooth_field(panel, scene, starts, positions, drawn);
  take_sheets(panel, run, frame.time, deformation);
  if (scene != nullptr) move_footings(panel, *scene, starts, displacements, deformation);
  if (deformation == 1) return panel;
  if (deformation != 0) panel.before = panel.scenery.soils;
  if (scene != nullptr) deform_surroundings(panel, *scene, starts, displacements, deformation);
  panel.particles.displacements = std::move(displacements);
  panel.particles.displacement_factor = deformation - 1;  // the positions hold it once
  return panel;
}

ValueRange range_of_instants(const std::vector<ValueRange>& extents, ColourMap map) {
  std::vector<double> ends;
  for (const ValueRange& e : extents)
    if (e.low <= e.high) ends.insert(ends.end(), {e.low, e.high});
  ValueRange extent = finite_extent(ends);
  if (is_diverging(map)) return centred_range(extent);
  constexpr double little = 0.02;  // of the span: tension of rounding errors needs no colours of its own
  if (extent.low < 0 && extent.high > 0 && extent.high < little * (extent.high - extent.low)) extent.high = 0;
  return rounded_range(extent);
}

ValueRange range_of_runs(const std::vector<std::vector<double>>& values, ColourMap map) {
  std::vector<ValueRange> extents;
  for (const auto& v : values) extents.push_back(robust_extent(v));
  return range_of_instants({usual_extent(extents)}, map);
}

ColourScale scale_of(const FieldSelection& field, const ShownUnit& unit, const std::optional<Case>& scene,
                     std::optional<ValueRange> range, bool usual) {
  ColourScale scale{.label = shown_label(field, unit), .map = usual_map(field), .range = range};
  if (usual && usually_logarithmic(field)) make_logarithmic(scale);
  if (field.name == "SoilId" && scene) {
    scale.label = "soil";
    for (const SoilCase& soil : scene->soils) scale.categories.push_back(soil.name);
  }
  return scale;
}

void make_logarithmic(ColourScale& scale) {
  constexpr double decades = 1e3;
  if (!scale.range || !(scale.range->high > 0)) return;
  scale.range->low = scale.range->high / decades;
  scale.logarithmic = true;
}

std::string time_text(double time) {
  if (time < 1000) return fmt::format("t = {:.{}g} s", time, time < 100 ? 3 : 4);
  time = std::round(1000 * time) / 1000;
  std::string text = "t =";
  const auto add = [&](double seconds, const char* unit) {
    const double whole = std::floor(time / seconds + 1e-9);
    if (whole > 0) text += fmt::format(" {:.0f} {}", whole, unit);
    time = std::max(0.0, time - whole * seconds);
  };
  add(86400, "d"), add(3600, "h"), add(60, "min");
  return time < 5e-4 ? text : text + fmt::format(" {:g} s", std::round(1000 * time) / 1000);
}

std::string panel_subtitle(const FinishedRun& run, double time, const std::string& title) {
  std::string text = time_text(time);
  const bool is_last = time >= run.series.frames.back().time;
  if (run.summary && is_last && run.summary->status == RunStatus::unstable) text += ", unstable";
  if (!run.scene) return text;
  const FormulationCase& f = run.scene->formulation;
  std::vector<std::string> parts = {std::string(motion_name(f.motion))};
  if (!f.kernel_correction) parts.push_back("without kernel correction");
  if (run.scene->loading.damping == 0 && !run.scene->loading.adaptive_damping) parts.push_back("undamped");
  for (const std::string& part : parts)
    if (title.find(part) == std::string::npos) text += ", " + part;
  return text;
}

}  // namespace porosph::render
