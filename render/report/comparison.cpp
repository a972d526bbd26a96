#include "render/report/comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "render/run/history_lines.hpp"
#include "render/run/run_panel.hpp"
#include "solver/space/place_text.hpp"
#include "vtk_io/finished_run/frame_pair.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"

namespace porosph::render {
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

ContourPanel side_panel(const Side& side, const FieldSelection& field, double factor,
                        const ComparisonChoice& choice) {
  ContourPanel panel = panel_of(side.run, side.frame, scaled(values_of(side.frame, field), factor),
                                choice.deformation, choice.style);
  panel.title = side.label;
  panel.subtitle = panel_subtitle(side.run, side.frame.time, side.label);
  return panel;
}

/// Drawn where the soil was at t = 0, as the two runs have it in different places later.
ContourPanel difference_panel(const Side& side, const std::vector<Point>& at, std::vector<double> values,
                              std::string title, std::string subtitle, FieldStyle style) {
  ContourPanel panel;
  panel.title = std::move(title);
  panel.subtitle = std::move(subtitle);
  panel.particles.positions = at;
  panel.particles.values = std::move(values);
  panel.particles.sizes = particle_sizes(side.run, side.frame);
  const Case* scene = side.run.scene ? &*side.run.scene : nullptr;
  if (style != FieldStyle::particles) add_smooth_field(panel, scene, at, at, at);
  if (scene == nullptr) return panel;
  panel.particles.cells = drawn_cells(*scene, at);
  panel.scenery = scenery_at(*scene, side.frame.time);
  return panel;
}

std::string norms_text(const FieldNorms& n) {
  return fmt::format("L2 {}, at most {}", relative_text(n.relative_l2), largest_text(n));
}

/// What is drawn, and with what.
struct Drawing {
  const Side &a, &b;
  const FramePair frames;
  const MaterialPoints& points;
  const std::optional<FemReference>& fem;
  const ComparisonChoice& choice;
  bool different_times() const { return !is_fair(a.run, b.run, frames); }
};

ContourPanel run_difference(const Drawing& d, const FieldSelection& field, double factor) {
  const auto values_a = d.points.sample_a(values_of(d.a.frame, field)),
             values_b = d.points.sample_b(values_of(d.b.frame, field));
  const FieldNorms n = norms(field, values_a, values_b, d.points.at, d.points.volumes, largest_of(values_b));
  const bool a_is_coarser =
      d.a.run.scene && d.b.run.scene && d.a.run.scene->particles.spacing > d.b.run.scene->particles.spacing;
  std::string subtitle = norms_text(n);
  if (d.different_times())
    subtitle = fmt::format("{:.3g} s − {:.3g} s: {}", d.a.frame.time, d.b.frame.time, subtitle);
  return difference_panel(a_is_coarser ? d.a : d.b, d.points.at,
                          scaled(difference(values_a, values_b), factor), d.a.label + " − " + d.b.label,
                          subtitle, d.choice.style);
}

ContourPanel fem_difference(const Drawing& d, const Side& side, const FieldSelection& field, double factor) {
  const std::vector<Point> starts = starts_of(side.frame);
  const FieldNorms n = fem_norm(side.frame, *d.fem, field, d.choice.left_out);
  return difference_panel(
      side, starts, scaled(difference(values_of(side.frame, field), d.fem->values(field, starts)), factor),
      side.label + " − finite elements", norms_text(n), d.choice.style);
}

/// Each difference has a range of its own: one may be a hundredth of another.
void scale_differences(std::span<ContourPanel> panels, const std::string& label,
                       std::optional<ValueRange> range) {
  for (ContourPanel& panel : panels)
    panel.own_scale = {
        .label = "Δ" + label,
        .map = ColourMap::cool_warm,
        .range = range ? *range : range_of_runs({panel.particles.values}, ColourMap::cool_warm)};
}

/// Differences to finite elements at particles need values of the field with its component.
bool drawable_with_fem(const FieldSelection& f) { return !(f.component.empty() && f.name == "Displacement"); }

void draw_field(const Drawing& d, const FieldSelection& field, const fs::path& file) {
  const ShownUnit unit = shown_unit(
      field.name, std::max(largest_of(values_of(d.a.frame, field)), largest_of(values_of(d.b.frame, field))));
  const bool with_fem = d.fem && drawable_with_fem(field);
  ContourFigure figure;
  figure.title = shown_name(field);
  figure.style = d.choice.style;
  figure.panels = {side_panel(d.a, field, unit.factor, d.choice),
                   side_panel(d.b, field, unit.factor, d.choice)};
  if (with_fem)
    figure.panels.push_back(
        fem_panel(*d.fem, d.b.run, d.b.frame, field, unit.factor, d.choice.deformation, d.choice.style));
  std::vector<std::vector<double>> values;
  for (const ContourPanel& panel : figure.panels) values.push_back(panel.particles.values);
  figure.scale =
      scale_of(field, unit, d.b.run.scene,
               d.choice.range ? *d.choice.range : range_of_runs(values, usual_map(field)), !d.choice.range);
  figure.panels.push_back(run_difference(d, field, unit.factor));
  if (with_fem)
    for (const Side* side : {&d.a, &d.b})
      figure.panels.push_back(fem_difference(d, *side, field, unit.factor));
  scale_differences(std::span(figure.panels).subspan(values.size()), shown_label(field, unit),
                    d.choice.difference_range);
  save_contours(figure, file);
}

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

/// `reference_time`: empty for finite elements, which are at rest.
std::string csv_rows(const std::string& values, double time, const std::string& reference,
                     const std::string& reference_time, const std::vector<FieldNorms>& all) {
  const auto number = [](double v) { return std::isfinite(v) ? fmt::format("{:.9g}", v) : std::string(); };
  std::string rows;
  for (const FieldNorms& n : all)
    rows += csv_line({values, reference, n.field.text(), number(n.relative_l2), number(n.max_abs),
                      number(n.where.x()), number(n.where.y()), fmt::format("{}", time), reference_time});
  return rows;
}

}  // namespace

ContourPanel fem_panel(const FemReference& fem, const FinishedRun& run, const Frame& frame,
                       const FieldSelection& field, double factor, double deformation, FieldStyle style) {
  const std::vector<Point> starts = starts_of(frame);
  ContourPanel panel;
  panel.title = "Finite elements";
  panel.subtitle = "at rest, at the particles";
  panel.particles.positions = starts;
  panel.particles.values = scaled(fem.values(field, starts), factor);
  panel.particles.sizes = particle_sizes(run, frame);
  if (run.scene) panel.particles.cells = drawn_cells(*run.scene, starts);
  const auto x = fem.values({"Displacement", "X"}, starts), y = fem.values({"Displacement", "Y"}, starts);
  std::vector<Point> displacements;
  for (std::size_t i = 0; i < starts.size(); ++i)
    displacements.push_back(std::isfinite(x[i]) ? Point(x[i], y[i]) : Point(0, 0));
  panel.scenery = scenery_of(fem.scene());
  if (style != FieldStyle::particles) {
    std::vector<Point> drawn = starts;
    for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] += deformation * displacements[i];
    add_smooth_field(panel, run.scene ? &*run.scene : nullptr, starts, starts, drawn);
  }
  if (run.scene && deformation != 1)
    deform_surroundings(panel, *run.scene, starts, displacements, deformation);
  panel.particles.displacements = std::move(displacements);
  panel.particles.displacement_factor = deformation;
  return panel;
}

ContourFigure difference_maps(const std::vector<const FinishedRun*>& runs,
                              const std::vector<const Frame*>& frames, const std::vector<std::string>& labels,
                              const std::optional<FemReference>& fem, const std::vector<LeftOut>& left_out,
                              const FieldSelection& field) {
  double largest = 0;
  for (const Frame* frame : frames) largest = std::max(largest, largest_of(values_of(*frame, field)));
  const ShownUnit unit = shown_unit(field.name, largest);
  const ComparisonChoice choice{.pictures = {}, .range = {}, .difference_range = {}, .left_out = left_out};
  const Side first{*runs[0], *frames[0], labels[0]};
  ContourFigure figure;
  figure.title = "Differences: " + name_in_sentence(field);
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const FramePair pair = last_frames(*runs[i], *runs[0]);
    if (!is_fair(*runs[i], *runs[0], pair)) continue;
    const Side side{*runs[i], *frames[i], labels[i]};
    const MaterialPoints points = common_points(*runs[i], *frames[i], *runs[0], *frames[0]);
    figure.panels.push_back(run_difference({side, first, pair, points, fem, choice}, field, unit.factor));
  }
  if (fem && drawable_with_fem(field))
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Side side{*runs[i], *frames[i], labels[i]};
      const MaterialPoints none{
          {}, {}, true, Sampler(std::vector<std::size_t>{}), Sampler(std::vector<std::size_t>{})};
      figure.panels.push_back(fem_difference({side, side, {}, none, fem, choice}, side, field, unit.factor));
    }
  scale_differences(figure.panels, shown_label(field, unit), std::nullopt);
  return figure;
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
    draw_field({side_a, side_b, {index_a, index_b}, points, fem, choice}, field,
               folder / result.pictures.back());
  }
  if (const auto charts = stress_histories({a, b}, labels); !charts.empty()) {
    result.pictures.push_back("history.png");
    save_charts({.title = "Effective vertical stress over time", .charts = charts}, folder / "history.png");
  }
  return result;
}

void write_norms(const Comparison& c, const std::string& label_a, const std::string& label_b,
                 const fs::path& folder) {
  const std::string fem = "finite elements";
  write_file(folder / "comparison.csv",
             "values,reference,field,relative_l2,max_abs,x,y,time,reference_time\n" +
                 csv_rows(label_a, c.time_a, label_b, fmt::format("{}", c.time_b), c.a_against_b) +
                 csv_rows(label_a, c.time_a, fem, "", c.a_against_fem) +
                 csv_rows(label_b, c.time_b, fem, "", c.b_against_fem));
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
  return fmt::format("{:.3g} {} at {} m", n.max_abs * unit.factor, unit.name,
                     place_text({n.where.x(), n.where.y()}));
}

}  // namespace porosph::render
