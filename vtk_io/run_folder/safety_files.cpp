#include "vtk_io/run_folder/safety_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "solver/printable.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/csv.hpp"

namespace porosph {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* any_shape = "Spencer on any shape";

std::string cells(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ',';
    append_csv_number(text, value);
  }
  return text;
}

/// null where there is none: no JSON number is infinite.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json strength_reduction_json(const SafetyAnswer& answer) {
  const StrengthReduction& found = *answer.particles;
  Json json;
  json["stable_at"] = found.stable_at > 0 ? Json(found.stable_at) : Json(nullptr);
  json["fails_at"] = number_or_null(found.fails_at);
  json["displacement_at_rest"] = found.at_rest;
  json["trials"] = found.trials.size();
  json["wall_seconds"] = answer.particle_seconds;
  return json;
}

Json limit_equilibrium_json(const SafetyAnswer& answer) {
  const limit_equilibrium::CriticalSurfaces& found = *answer.limit_equilibrium;
  Json json;
  json["bishop"] = found.bishop.factor;
  json["spencer"] = found.spencer ? Json(found.spencer->factor) : Json(nullptr);
  if (found.general) json["spencer_any_shape"] = found.general->factor;
  json["wall_seconds"] = answer.limit_equilibrium_seconds;
  return json;
}

}  // namespace

std::vector<NamedSurface> slip_surfaces(const SafetyAnswer& answer) {
  std::vector<NamedSurface> surfaces;
  if (!answer.limit_equilibrium) return surfaces;
  const limit_equilibrium::CriticalSurfaces& found = *answer.limit_equilibrium;
  surfaces.push_back({"Bishop on circles", found.bishop});
  if (found.spencer) surfaces.push_back({"Spencer on circles", *found.spencer});
  if (found.general) surfaces.push_back({any_shape, *found.general});
  return surfaces;
}

namespace {

/// The surface with the least factor; there is one where limit equilibrium has an answer.
NamedSurface least(const SafetyAnswer& answer) {
  return std::ranges::min(slip_surfaces(answer), {}, [](const NamedSurface& s) { return s.surface.factor; });
}

}  // namespace

std::string_view words_of(TrialEnd end) {
  switch (end) {
    case TrialEnd::at_rest:
      return "at rest";
    case TrialEnd::moved_far:
      return "moved far";
    case TrialEnd::flows:
      return "flows";
    case TrialEnd::not_at_rest:
      return "not at rest";
    case TrialEnd::broke_down:
      return "broke down";
  }
  return "";
}

std::string bracket_text(double stable_at, double fails_at) {
  if (fails_at == never) return fmt::format("above {:.4g}", stable_at);
  if (stable_at == 0) return fmt::format("below {:.4g}", fails_at);
  return fmt::format("{:.4g} to {:.4g}", stable_at, fails_at);
}

Summary::Safety in_short(const SafetyAnswer& answer) {
  Summary::Safety safety;
  if (answer.particles)
    safety.stable_at = answer.particles->stable_at, safety.fails_at = answer.particles->fails_at;
  if (answer.limit_equilibrium) safety.limit_equilibrium = least(answer).surface.factor;
  for (const std::string& warning : answer.warnings)
    safety.note += (safety.note.empty() ? "" : "; ") + warning;
  return safety;
}

std::string safety_folder(const std::string& stage) {
  const bool plain = std::ranges::all_of(
      stage, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
  return plain && !stage.empty() ? "safety_" + stage : "";
}

void write_trials(const std::filesystem::path& file, const StrengthReduction& found) {
  std::string csv = "factor,displacement,unbalanced_force_ratio,steps,end\n";
  for (const StrengthTrial& t : found.trials)
    csv += cells({t.factor, t.displacement, t.unbalanced, static_cast<double>(t.steps)}) + "," +
           std::string(words_of(t.end)) + "\n";
  write_file(file, csv);
}

void write_safety_curve(const std::filesystem::path& file, const SafetyCurve& curve) {
  std::string csv = csv_line({curve.key, "stable_at", "fails_at", "bishop", "spencer", "spencer_any_shape"});
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < curve.values.size(); ++i) {
    const SafetyAnswer& a = curve.answers[i];
    const auto& surfaces = a.limit_equilibrium;
    csv += cells({curve.values[i], a.particles && a.particles->stable_at > 0 ? a.particles->stable_at : none,
                  a.particles && a.particles->fails_at < never ? a.particles->fails_at : none,
                  surfaces ? surfaces->bishop.factor : none,
                  surfaces && surfaces->spencer ? surfaces->spencer->factor : none,
                  surfaces && surfaces->general ? surfaces->general->factor : none}) +
           "\n";
  }
  write_file(file, csv);
}

void write_slip_surfaces(const std::filesystem::path& file, const SafetyAnswer& answer) {
  std::string csv = "surface,x,y\n";
  for (const NamedSurface& named : slip_surfaces(answer))
    for (const Point& p : named.surface.points) csv += csv_line({named.name, cells({p.x()}), cells({p.y()})});
  write_file(file, csv);
}

std::string disagreement(const SafetyAnswer& answer) {
  constexpr double tolerable = 0.05;
  if (!answer.particles || !answer.limit_equilibrium) return "";
  const NamedSurface surface = least(answer);
  const double factor = surface.surface.factor, stable = answer.particles->stable_at,
               fails = answer.particles->fails_at;
  if (stable > (1 + tolerable) * factor)
    return fmt::format(
        "the particles still stand at {:.4g}, {:.0f} % above the {:.4g} of limit equilibrium ({}): a layer "
        "of few rows of particles hardly slides in them{}. Take the smaller factor, or a particles.spacing "
        "that gives weak layers two rows or more",
        stable, 100 * (stable / factor - 1), factor, surface.name,
        surface.name == any_shape ? ", and without friction surfaces of any shape come out too low" : "");
  if (fails < (1 - tolerable) * factor)
    return fmt::format(
        "the particles fail at {:.4g}, {:.0f} % below the {:.4g} of limit equilibrium ({}): look at "
        "mechanism.png for how they fail, and take the smaller factor",
        fails, 100 * (1 - fails / factor), factor, surface.name);
  return "";
}

void write_safety_summary(const std::filesystem::path& file, const SafetyAnswer& answer) {
  Json json;
  json["title"] = printable(answer.title);
  if (answer.particles) json["strength_reduction"] = strength_reduction_json(answer);
  if (answer.limit_equilibrium) json["limit_equilibrium"] = limit_equilibrium_json(answer);
  if (!answer.warnings.empty()) json["warnings"] = answer.warnings;
  write_file(file, json.dump(2) + "\n");
}

}  // namespace porosph
