#include "vtk_io/run_folder/summary_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/fem_check_json.hpp"
#include "vtk_io/run_folder/json_object.hpp"
#include "vtk_io/run_folder/run_status_names.hpp"

namespace porosph {
namespace {

std::string_view reason(double value) {
  for (const auto& [number, name] : NotFinite::infinite) {
    if (value == number) return name;
  }
  return NotFinite::nan;
}

void put(Json& object, const std::string& key, double value) {
  if (std::isfinite(value)) {
    object[key] = value;
  } else {
    object[key] = nullptr;
    object[NotFinite::key(key)] = reason(value);
  }
}

std::string_view name_of(RunStatus status) {
  for (const auto& [value, name] : run_status_names) {
    if (value == status) return name;
  }
  throw std::invalid_argument("summary: unknown status");
}

Json to_json(const Summary::Probe& probe) {
  Json values = Json::object();
  for (const auto& [quantity, value] : probe.values) put(values, quantity, value);
  return {{"position", Json::array({probe.x, probe.y})}, {"values", values}};
}

Json to_json(const ErrorNorms& norms) {
  Json object;
  put(object, "relative_l2", norms.relative_l2);
  put(object, "max_abs", norms.max_abs);
  return object;
}

Json to_json(const Summary::Footing& footing) {
  Json json;
  put(json, "force", footing.force), put(json, "shear", footing.shear);
  put(json, "settlement", footing.settlement), put(json, "width", footing.width);
  return json;
}

Json to_json(const Summary::Sheet& sheet) {
  Json json;
  put(json, "moment", sheet.moment), put(json, "shear", sheet.shear);
  put(json, "axial", sheet.axial), put(json, "displacement", sheet.displacement);
  return json;
}

template <typename Value>
Json object_of(const std::map<std::string, Value>& entries) {
  Json object = Json::object();
  for (const auto& [name, value] : entries) object[name] = to_json(value);
  return object;
}

Json to_json(const Summary::Safety& safety) {
  Json json;
  put(json, "stable_at", safety.stable_at), put(json, "fails_at", safety.fails_at);
  if (safety.limit_equilibrium > 0) put(json, "limit_equilibrium", safety.limit_equilibrium);
  if (!safety.note.empty()) json["note"] = safety.note;
  return json;
}

Json to_json(const Summary::Stage& stage) {
  Json json;
  json["name"] = stage.name, json["ended"] = stage.ended;
  put(json, "start", stage.start), put(json, "time", stage.time);
  json["steps"] = stage.steps, json["particles"] = stage.particles;
  put(json, "unbalanced_force_ratio", stage.unbalanced_force_ratio);
  put(json, "largest_displacement", stage.largest_displacement);
  json["probes"] = object_of(stage.probes);
  if (!stage.footings.empty()) json["footings"] = object_of(stage.footings);
  if (!stage.sheets.empty()) json["sheets"] = object_of(stage.sheets);
  if (stage.safety) json["safety"] = to_json(*stage.safety);
  return json;
}

Json to_json(const Summary::Zigzag& zigzag) {
  Json json;
  put(json, "rms", zigzag.rms), put(json, "quantile_99", zigzag.quantile);
  put(json, "largest", zigzag.largest);
  put(json, "x", zigzag.x), put(json, "y", zigzag.y);
  return json;
}

Json to_json(const Summary::EnergyBudget& e) {
  Json json;
  put(json, "released", e.released), put(json, "kinetic", e.kinetic), put(json, "elastic", e.elastic);
  put(json, "plastic", e.plastic), put(json, "control", e.control), put(json, "contact", e.contact);
  put(json, "wall_friction", e.friction), put(json, "walls", e.walls);
  put(json, "stress_diffusion", e.diffusion), put(json, "bulk_viscosity", e.bulk_viscosity);
  put(json, "pore_water", e.water), put(json, "unaccounted", e.unaccounted);
  return json;
}

Json to_json(const Summary::Seepage& seepage) {
  Json json;
  json["through_faces"] = seepage.through_faces;
  put(json, "imbalance", seepage.imbalance);
  json["newton_steps"] = seepage.newton_steps;
  json["krylov_iterations"] = seepage.krylov_iterations;
  for (const auto& [name, discharge] : seepage.sections) put(json["sections"], name, discharge);
  return json;
}

Json to_json(const Summary::Consolidation& c) {
  Json json;
  json["flow_steps"] = c.flow_steps, json["pressure_solves"] = c.pressure_solves;
  json["krylov_iterations"] = c.krylov_iterations, json["soil_sweeps"] = c.soil_sweeps;
  put(json, "drained", c.drained), put(json, "imbalance", c.imbalance);
  return json;
}

Json to_json(const Summary::WaterMotion& c) {
  Json json;
  put(json, "began", c.began);
  json["steps"] = c.steps, json["krylov_iterations"] = c.krylov_iterations, json["renewals"] = c.renewals;
  put(json, "drained", c.drained), put(json, "imbalance", c.imbalance), put(json, "misfit", c.misfit);
  return json;
}

Json to_json(const Summary::TransientSeepage& c) {
  Json json;
  json["flow_steps"] = c.flow_steps, json["refused_steps"] = c.refused_steps;
  json["newton_steps"] = c.newton_steps, json["krylov_iterations"] = c.krylov_iterations;
  json["soil_sweeps"] = c.soil_sweeps;
  put(json, "entered", c.entered), put(json, "left", c.left), put(json, "gained", c.gained);
  put(json, "imbalance", c.imbalance);
  return json;
}

Json to_json(const Summary& summary) {
  Json json;
  json["title"] = summary.title;
  json["status"] = name_of(summary.status);
  json["message"] = summary.message;
  json["particles"] = summary.particles;
  json["steps"] = summary.steps;
  put(json, "time", summary.time);
  put(json, "time_step", summary.time_step);
  if (summary.courant > 0) put(json, "courant", summary.courant);
  json["threads"] = summary.threads;
  put(json, "wall_seconds", summary.wall_seconds);
  put(json, "stepping_seconds", summary.stepping_seconds);
  put(json, "particle_steps_per_second", summary.particle_steps_per_second);
  json["peak_memory_bytes"] = summary.peak_memory_bytes;
  for (const auto& [soil, inertia] : summary.scaled_inertia) put(json["scaled_inertia"], soil, inertia);
  json["formulation"] = summary.formulation;
  json["kernel_correction"] = summary.kernel_correction;
  put(json, "unbalanced_force_ratio", summary.unbalanced_force_ratio);
  put(json, "energy_growth", summary.energy_growth);
  if (summary.zigzag) json["zigzag"] = to_json(*summary.zigzag);
  if (summary.energy) json["energy_budget"] = to_json(*summary.energy);
  if (summary.seepage) json["seepage"] = to_json(*summary.seepage);
  if (summary.consolidation) json["consolidation"] = to_json(*summary.consolidation);
  if (summary.motion) json["motion"] = to_json(*summary.motion);
  if (summary.transient) json["transient_seepage"] = to_json(*summary.transient);
  json["probes"] = object_of(summary.probes);
  if (!summary.footings.empty()) json["footings"] = object_of(summary.footings);
  if (!summary.sheets.empty()) json["sheets"] = object_of(summary.sheets);
  for (const Summary::Stage& stage : summary.stages) json["stages"].push_back(to_json(stage));
  if (!summary.errors.empty()) json["errors"] = object_of(summary.errors);
  if (summary.finite_elements) json["finite_elements"] = to_json(*summary.finite_elements);
  json["warnings"] = summary.warnings;
  json["skipped"] = summary.skipped;
  return json;
}

}  // namespace

void write_summary(const std::filesystem::path& file, const Summary& summary) {
  // A message may quote a path that is not UTF-8: better with a replacement character than lost.
  const auto text = to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace);
  write_file(file, text + "\n");
}

}  // namespace porosph
