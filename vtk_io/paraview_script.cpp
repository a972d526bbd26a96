#include "vtk_io/paraview_script.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "solver/analysis/frame_values.hpp"
#include "solver/boundary/support.hpp"
#include "solver/fields/field_table.hpp"
#include "vtk_io/resources.hpp"

namespace porosph {
namespace {

struct Colouring {
  std::string field, component;
};

Colouring colouring_of(const Frame& frame) {
  for (const auto& field : frame.fields) {
    if (field.name == "EffectiveStress" && std::ranges::count(field.components, "YY") == 1)
      return {field.name, "YY"};
  }
  if (frame.fields.empty()) return {};
  const auto& first = frame.fields.front();
  return {first.name, first.components.empty() ? "" : first.components.front()};
}

/// A Python literal: JSON's escapes, numbers and lists are also Python's.
std::string python(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Replaces the line of `text` that begins with `start`; a script without it is a mistake of ours.
void replace_line(std::string& text, const std::string& start, const std::string& line) {
  const std::size_t begin = text.find("\n" + start);
  if (begin == std::string::npos) throw std::logic_error("no line '" + start + "' in a ParaView script");
  text.replace(begin + 1, text.find('\n', begin + 1) - begin - 1, line);
}

/// A script of vtk_io/paraview that stands alone.
std::string with_common(std::string_view script) {
  std::string text(script);
  replace_line(text, "from porosph_common import", std::string(resources::paraview_common));
  return text;
}

/// Of polygons, as lists of x and y in turn.
nlohmann::json rings_of(const std::vector<SoilCase>& soils) {
  auto rings = nlohmann::json::array();
  const auto add = [&](const Polygon& ring) {
    auto& numbers = rings.emplace_back(nlohmann::json::array());
    for (const Point& corner : ring) numbers.push_back(corner.x()), numbers.push_back(corner.y());
  };
  for (const SoilCase& soil : soils) {
    add(soil.polygon);
    for (const Polygon& hole : soil.holes) add(hole);
  }
  return rings;
}

}  // namespace

ScriptScene script_scene(const Case& scene) {
  return {.title = scene.title,
          .spacing = scene.particles.spacing,
          .smoothing_length = scene.smoothing_length(),
          .boundary = scene.output.boundary,
          .probes = scene.probes,
          .water = scene.water,
          .soils = scene.soils,
          .boundaries = scene.boundaries};
}

std::string paraview_script(const std::filesystem::path& folder, const std::string& pvd, const Frame& frame,
                            const ScriptScene& scene) {
  const auto [field, component] = colouring_of(frame);
  const std::string unit = field_unit(field);
  const bool in_kilo = unit == "Pa";
  nlohmann::json run = {
      {"series", pvd},
      {"folder", folder.string()},
      {"title", scene.title},
      {"spacing", scene.spacing},
      {"smoothing_length",
       has_field(frame, "Mass") && has_field(frame, "Density") ? scene.smoothing_length : 0},
      {"field", field},
      {"component", component},
      {"unit", in_kilo ? "kPa" : unit},
      {"factor", in_kilo ? 1e-3 : 1},
      {"boundary", scene.boundary ? 1 : 0},
      {"probes", nlohmann::json::array()},
      {"outlines", rings_of(scene.soils)},
      {"supports", nlohmann::json::array()},
      {"water", nlohmann::json::array()},
      {"level_over_time", nlohmann::json::array()}};
  for (const ProbeCase& probe : scene.probes)
    run["probes"].push_back({probe.name, probe.position.x(), probe.position.y()});
  for (const BoundaryCase& b : scene.boundaries)
    if (b.kind != BoundaryKind::periodic)
      run["supports"].push_back(
          {b.kind == BoundaryKind::roller ? "roller" : "fixed", b.from.x(), b.from.y(), b.to.x(), b.to.y()});
  constexpr double far = 1e30;  // JSON has no infinity; the script cuts lines at the particles
  for (const Point& step : scene.water.level_over_time)
    run["level_over_time"].push_back({step.x(), step.y()});
  if (run["level_over_time"].empty())
    for (const WaterStretch& s : scene.water.stretches)
      run["water"].push_back({std::max(s.x_from, -far), std::min(s.x_to, far), s.level});
  std::string script = with_common(resources::paraview_open);
  replace_line(script, "RUN = ", "RUN = " + python(run));
  return script;
}

std::string paraview_comparison_script(const std::filesystem::path& folder, const std::filesystem::path& a,
                                       const std::filesystem::path& b) {
  std::string script = with_common(resources::paraview_compare);
  replace_line(script, "FOLDERS = ", "FOLDERS = " + python({a.generic_string(), b.generic_string()}));
  replace_line(script, "WRITTEN_IN = ",
               "WRITTEN_IN = " + python(folder.generic_string()) +
                   "  # ParaView does not tell a script of --script where it is");
  return script;
}

}  // namespace porosph
