#include "render/report/comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "render/run/history_lines.hpp"
#include "render/run/run_panel.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"

namespace porosph {
namespace {

namespace fs = std::filesystem;

struct Side {
  const FinishedRun& run;
  const Frame& frame;
  std::string label;
};

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

ContourPanel side_panel(const Side& side, const FieldSelection& field, double factor, double deformation) {
  ContourPanel panel =
      panel_of(side.run, side.frame, scaled(values_of(side.frame, field), factor), deformation);
  panel.title = side.label;
  panel.subtitle = time_text(side.frame.time);
  if (side.run.scene) panel.subtitle += ", " + formulation_text(side.run);
  return panel;
}

/// Drawn where the soil was at t = 0, as the two runs have it in different places later.
ContourPanel difference_panel(const Side& side, const std::vector<Point>& at, std::vector<double> values,
                              std::string title) {
  ContourPanel panel;
  panel.title = std::move(title);
  panel.subtitle = "drawn at the start's positions";
  panel.particles.positions = at;
  panel.particles.values = std::move(values);
  panel.particles.sizes = particle_sizes(side.run, side.frame);
  if (!side.run.scene) return panel;
  panel.particles.cells = drawn_cells(*side.run.scene, at);
  panel.scenery = scenery_of(*side.run.scene);
  return panel;
}

void share_scale(const std::vector<ContourPanel*>& panels, const std::string& label) {
  std::vector<std::vector<double>> values;
  for (const ContourPanel* panel : panels) values.push_back(panel->particles.values);
  const ColourScale scale{label, ColourMap::cool_warm, shared_range(values, ColourMap::cool_warm)};
  for (ContourPanel* panel : panels) panel->own_scale = scale;
}

std::string with_difference(const std::string& label) { return "Δ" + label; }

void draw_field(const Side& a, const Side& b, const MaterialPoints& points,
                const std::optional<FemReference>& fem, const FieldSelection& field, double deformation,
                const fs::path& file) {
  const auto values_a = values_of(a.frame, field), values_b = values_of(b.frame, field);
  const ShownUnit unit = shown_unit(field.name, std::max(largest_of(values_a), largest_of(values_b)));
  ContourFigure figure;
  figure.title = shown_name(field);
  figure.panels = {side_panel(a, field, unit.factor, deformation),
                   side_panel(b, field, unit.factor, deformation)};
  if (fem) figure.panels.push_back(fem_panel(*fem, b.run, b.frame, field, unit.factor, deformation));
  std::vector<std::vector<double>> values;
  for (const ContourPanel& panel : figure.panels) values.push_back(panel.particles.values);
  figure.scale = {shown_label(field, unit), usual_map(field), shared_range(values, usual_map(field))};
  const bool a_is_coarser =
      a.run.scene && b.run.scene && a.run.scene->particles.spacing > b.run.scene->particles.spacing;
  figure.panels.push_back(
      difference_panel(a_is_coarser ? a : b, points.at,
                       scaled(difference(points.sample_a(values_a), points.sample_b(values_b)), unit.factor),
                       a.label + " − " + b.label));
  const std::string delta = with_difference(shown_label(field, unit));
  if (fem) {
    for (const Side& side : {a, b}) {
      const std::vector<Point> starts = starts_of(side.frame);
      figure.panels.push_back(difference_panel(
          side, starts,
          scaled(difference(values_of(side.frame, field), fem->values(field, starts)), unit.factor),
          side.label + " − finite elements"));
    }
  }
  std::vector<ContourPanel*> differences;
  for (std::size_t i = values.size(); i < figure.panels.size(); ++i) differences.push_back(&figure.panels[i]);
  share_scale(differences, delta);
  save_contours(figure, file);
}

/// Differences to finite elements at particles need values of the field with its component.
bool drawable_with_fem(const FieldSelection& f) { return !(f.component.empty() && f.name == "Displacement"); }

nlohmann::ordered_json json_of(const std::vector<FieldNorms>& all) {
  auto object = nlohmann::ordered_json::object();
  for (const FieldNorms& n : all) {
    auto& entry = object[n.field.text()];
    const auto put = [&](const char* key, double value, const char* reason) {
      if (std::isfinite(value))
        entry[key] = value;
      else
        entry[key] = nullptr, entry[std::string(key) + "_reason"] = reason;
    };
    put("relative_l2", n.relative_l2, std::isfinite(n.max_abs) ? "the reference is zero" : "not finite");
    put("max_abs", n.max_abs, "not finite");
    entry["where"] = {n.where.x(), n.where.y()};
  }
  return object;
}

std::string csv_rows(const std::string& values, const std::string& reference,
                     const std::vector<FieldNorms>& all) {
  const auto number = [](double v) { return std::isfinite(v) ? fmt::format("{:.9g}", v) : std::string(); };
  std::string rows;
  for (const FieldNorms& n : all)
    rows += csv_line({values, reference, n.field.text(), number(n.relative_l2), number(n.max_abs),
                      number(n.where.x()), number(n.where.y())});
  return rows;
}

}  // namespace

ContourPanel fem_panel(const FemReference& fem, const FinishedRun& run, const Frame& frame,
                       const FieldSelection& field, double factor, double deformation) {
  const std::vector<Point> starts = starts_of(frame);
  ContourPanel panel;
  panel.title = "Finite elements";
  panel.subtitle = "at rest, at the particles";
  panel.particles.positions = starts;
  panel.particles.values = scaled(fem.values(field, starts), factor);
  panel.particles.sizes = particle_sizes(run, frame);
  if (run.scene) panel.particles.cells = drawn_cells(*run.scene, starts);
  const auto x = fem.values({"Displacement", "X"}, starts), y = fem.values({"Displacement", "Y"}, starts);
  for (std::size_t i = 0; i < starts.size(); ++i)
    panel.particles.displacements.push_back(std::isfinite(x[i]) ? Point(x[i], y[i]) : Point(0, 0));
  panel.particles.displacement_factor = deformation;
  panel.scenery = scenery_of(fem.scene());
  return panel;
}

Comparison compare_runs(const FinishedRun& a, std::size_t index_a, const FinishedRun& b, std::size_t index_b,
                        const std::optional<FemReference>& fem, const ComparisonChoice& choice,
                        const fs::path& folder) {
  if (const std::string reason = obstacle(a, b); !reason.empty())
    throw std::runtime_error(
        fmt::format("{} and {} cannot be compared: {}", a.folder.string(), b.folder.string(), reason));
  if (fem)
    for (const FinishedRun* run : {&a, &b}) require_same_problem(*run, *fem);
  const Frame frame_a = frame_of(a, index_a), frame_b = frame_of(b, index_b);
  const std::vector<std::string> labels = run_labels({a, b});
  const Side side_a{a, frame_a, labels[0]}, side_b{b, frame_b, labels[1]};
  const MaterialPoints points = common_points(a, frame_a, b, frame_b);
  Comparison result{.time_a = frame_a.time,
                    .time_b = frame_b.time,
                    .particle_by_particle = points.particle_by_particle,
                    .points = points.at.size(),
                    .a_against_b = run_norms(frame_a, frame_b, points),
                    .a_against_fem = {},
                    .b_against_fem = {},
                    .pictures = {}};
  if (fem) {
    result.a_against_fem = fem_norms(frame_a, *fem, choice.left_out);
    result.b_against_fem = fem_norms(frame_b, *fem, choice.left_out);
  }
  make_folder(folder);
  for (const FieldSelection& field : choice.pictures) {
    result.pictures.push_back(file_name(field.text()) + ".png");
    draw_field(side_a, side_b, points, drawable_with_fem(field) ? fem : std::nullopt, field,
               choice.deformation, folder / result.pictures.back());
  }
  if (const auto charts = stress_histories({a, b}, labels); !charts.empty()) {
    result.pictures.push_back("history.png");
    save_charts({.title = "Effective vertical stress over time", .charts = charts}, folder / "history.png");
  }
  return result;
}

void write_norms(const Comparison& c, const std::string& label_a, const std::string& label_b,
                 const fs::path& folder) {
  write_file(folder / "comparison.csv", "values,reference,field,relative_l2,max_abs,x,y\n" +
                                            csv_rows(label_a, label_b, c.a_against_b) +
                                            csv_rows(label_a, "finite elements", c.a_against_fem) +
                                            csv_rows(label_b, "finite elements", c.b_against_fem));
  nlohmann::ordered_json json = {{"a", {{"run", label_a}, {"time", c.time_a}}},
                                 {"b", {{"run", label_b}, {"time", c.time_b}}},
                                 {"points", c.points},
                                 {"particle_by_particle", c.particle_by_particle},
                                 {"a_against_b", json_of(c.a_against_b)}};
  if (!c.a_against_fem.empty()) {
    json["a_against_fem"] = json_of(c.a_against_fem);
    json["b_against_fem"] = json_of(c.b_against_fem);
  }
  write_file(folder / "comparison.json", json.dump(2) + "\n");
}

std::string relative_text(double relative_l2) {
  return std::isfinite(relative_l2) ? fmt::format("{:.3g} %", 100 * relative_l2) : "reference is zero";
}

std::string largest_text(const FieldNorms& n) {
  const ShownUnit unit = shown_unit(n.field.name, n.max_abs);
  return fmt::format("{:.3g} {} at ({:.4g}, {:.4g}) m", n.max_abs * unit.factor, unit.name, n.where.x(),
                     n.where.y());
}

}  // namespace porosph
