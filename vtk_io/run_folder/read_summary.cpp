#include <map>
#include <tuple>

#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/fem_check_json.hpp"
#include "vtk_io/run_folder/json_object.hpp"
#include "vtk_io/run_folder/run_status_names.hpp"
#include "vtk_io/run_folder/summary_json.hpp"

namespace porosph {
namespace {

RunStatus status_from(const JsonObject& json) {
  const auto text = json.text("status");
  for (const auto& [status, name] : run_status_names) {
    if (text == name) return status;
  }
  json.fail("status", "must be completed, equilibrium, unstable or interrupted", json.at("status"));
}

Summary::Probe probe_from(const JsonObject& json) {
  Summary::Probe probe;
  std::tie(probe.x, probe.y) = json.position("position");
  const auto values = json.object("values");
  for (const auto& quantity : values.keys()) {
    if (!values.is_reason(quantity)) probe.values[quantity] = values.number(quantity);
  }
  return probe;
}

Summary::Footing footing_from(const JsonObject& f) {
  return {.force = f.number("force"),
          .shear = f.number("shear"),
          .settlement = f.number("settlement"),
          .width = f.number("width")};
}

Summary::Sheet sheet_from(const JsonObject& s) {
  return {.moment = s.number("moment"),
          .shear = s.number("shear"),
          .axial = s.number("axial"),
          .displacement = s.number("displacement")};
}

/// Its objects, by their names.
template <class Value>
std::map<std::string, Value> all_of(const JsonObject& json, Value (*value_from)(const JsonObject&)) {
  std::map<std::string, Value> values;
  for (const auto& name : json.keys()) values[name] = value_from(json.object(name));
  return values;
}

/// The same of a key that older runs and other cases have not.
template <class Value>
std::map<std::string, Value> all_if_there(const JsonObject& json, const char* key,
                                          Value (*value_from)(const JsonObject&)) {
  if (!json.has(key)) return {};
  return all_of(json.object(key), value_from);
}

Summary::Safety safety_from(const JsonObject& json) {
  return {.stable_at = json.number("stable_at"),
          .fails_at = json.number("fails_at"),
          .limit_equilibrium = json.has("limit_equilibrium") ? json.number("limit_equilibrium") : 0,
          .note = json.has("note") ? json.text("note") : ""};
}

Summary::Stage stage_from(const JsonObject& json) {
  return {.name = json.text("name"),
          .ended = json.text("ended"),
          .start = json.number("start"),
          .time = json.number("time"),
          .steps = json.integer<std::int64_t>("steps"),
          .particles = json.integer<std::int64_t>("particles"),
          .unbalanced_force_ratio = json.number("unbalanced_force_ratio"),
          .largest_displacement = json.number("largest_displacement"),
          .probes = all_of(json.object("probes"), probe_from),
          .footings = all_if_there(json, "footings", footing_from),
          .sheets = all_if_there(json, "sheets", sheet_from),
          .safety = json.has("safety") ? std::optional(safety_from(json.object("safety"))) : std::nullopt};
}

ErrorNorms norms_from(const JsonObject& norms) {
  return {norms.number("relative_l2"), norms.number("max_abs")};
}

Summary::EnergyBudget energy_from(const JsonObject& e) {
  const auto newer = [&](const char* key) { return e.has(key) ? e.number(key) : 0; };  // older runs have none
  return {.released = e.number("released"),
          .kinetic = e.number("kinetic"),
          .elastic = e.number("elastic"),
          .plastic = e.number("plastic"),
          .control = e.number("control"),
          .contact = newer("contact"),
          .friction = newer("wall_friction"),
          .walls = newer("walls"),
          .diffusion = e.number("stress_diffusion"),
          .bulk_viscosity = e.number("bulk_viscosity"),
          .water = newer("pore_water"),
          .unaccounted = e.number("unaccounted")};
}

std::map<std::string, double> numbers_of(const JsonObject& json) {
  std::map<std::string, double> numbers;
  for (const auto& name : json.keys()) numbers[name] = json.number(name);
  return numbers;
}

Summary::Zigzag zigzag_from(const JsonObject& json) {
  return {json.number("rms"), json.number("quantile_99"), json.number("largest"), json.number("x"),
          json.number("y")};
}

Summary::Seepage seepage_from(const JsonObject& json) {
  Summary::Seepage seepage{json.numbers("through_faces"), json.number("imbalance"),
                           json.integer<int>("newton_steps"), json.integer<int>("krylov_iterations")};
  if (!json.has("sections")) return seepage;
  seepage.sections = numbers_of(json.object("sections"));
  return seepage;
}

Summary::TransientSeepage transient_seepage_from(const JsonObject& json) {
  const auto count = [&](const char* key) { return json.integer<std::int64_t>(key); };
  return {count("flow_steps"),        count("refused_steps"), count("newton_steps"),
          count("krylov_iterations"), count("soil_sweeps"),   json.number("entered"),
          json.number("left"),        json.number("gained"),  json.number("imbalance")};
}

Summary::Consolidation consolidation_from(const JsonObject& json) {
  const auto count = [&](const char* key) { return json.integer<std::int64_t>(key); };
  return {count("flow_steps"),  count("pressure_solves"), count("krylov_iterations"),
          count("soil_sweeps"), json.number("drained"),   json.number("imbalance")};
}

Summary::WaterMotion motion_from(const JsonObject& json) {
  const auto count = [&](const char* key) { return json.integer<std::int64_t>(key); };
  return {json.number("began"),   count("steps"),           count("krylov_iterations"), count("renewals"),
          json.number("drained"), json.number("imbalance"), json.number("misfit")};
}

Summary summary_from(const JsonObject& json) {
  Summary summary;
  summary.title = json.text("title");
  summary.status = status_from(json);
  summary.message = json.text("message");
  summary.particles = json.integer<std::int64_t>("particles");
  summary.steps = json.integer<std::int64_t>("steps");
  summary.time = json.number("time");
  summary.time_step = json.number("time_step");
  if (json.has("courant")) summary.courant = json.number("courant");
  summary.threads = json.integer<int>("threads");
  summary.wall_seconds = json.number("wall_seconds");
  summary.stepping_seconds = json.number("stepping_seconds");
  summary.particle_steps_per_second = json.number("particle_steps_per_second");
  summary.peak_memory_bytes = json.integer<std::int64_t>("peak_memory_bytes");
  if (json.has("scaled_inertia")) summary.scaled_inertia = numbers_of(json.object("scaled_inertia"));
  summary.formulation = json.text("formulation");
  summary.kernel_correction = json.truth("kernel_correction");
  summary.unbalanced_force_ratio = json.number("unbalanced_force_ratio");
  summary.energy_growth = json.number("energy_growth");
  summary.probes = all_of(json.object("probes"), probe_from);
  summary.footings = all_if_there(json, "footings", footing_from);
  summary.sheets = all_if_there(json, "sheets", sheet_from);
  if (json.has("stages"))
    for (const JsonObject& stage : json.objects("stages")) summary.stages.push_back(stage_from(stage));
  summary.errors = all_if_there(json, "errors", norms_from);
  if (json.has("energy_budget")) summary.energy = energy_from(json.object("energy_budget"));
  if (json.has("zigzag")) summary.zigzag = zigzag_from(json.object("zigzag"));
  if (json.has("seepage")) summary.seepage = seepage_from(json.object("seepage"));
  if (json.has("transient_seepage"))
    summary.transient = transient_seepage_from(json.object("transient_seepage"));
  if (json.has("consolidation")) summary.consolidation = consolidation_from(json.object("consolidation"));
  if (json.has("motion")) summary.motion = motion_from(json.object("motion"));
  if (json.has("finite_elements")) summary.finite_elements = fem_check_from(json.at("finite_elements"));
  if (json.has("warnings")) summary.warnings = json.texts("warnings");
  const auto skipped = json.object("skipped");
  for (const auto& name : skipped.keys()) summary.skipped[name] = skipped.text(name);
  return summary;
}

}  // namespace

Summary read_summary(const std::filesystem::path& file) {
  const auto text = read_file(file);
  try {
    return summary_from(JsonObject(file, "", Json::parse(text)));
  } catch (const Json::exception& error) {
    throw ReadError(file, error.what());
  }
}

}  // namespace porosph
