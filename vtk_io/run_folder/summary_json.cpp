#include "vtk_io/run_folder/summary_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/printable.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/fem_check_json.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<RunStatus, std::string_view>, 4> status_names{{
    {RunStatus::completed, "completed"},
    {RunStatus::equilibrium, "equilibrium"},
    {RunStatus::unstable, "unstable"},
    {RunStatus::interrupted, "interrupted"},
}};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<std::pair<double, std::string_view>, 2> infinite_reasons{{
    {infinity, "plus infinity"},
    {-infinity, "minus infinity"},
}};
constexpr std::string_view nan_reason = "not a number";

std::string reason_key(const std::string& key) { return key + "_reason"; }

std::string_view reason(double value) {
  for (const auto& [number, name] : infinite_reasons) {
    if (value == number) return name;
  }
  return nan_reason;
}

void put(Json& object, const std::string& key, double value) {
  if (std::isfinite(value)) {
    object[key] = value;
  } else {
    object[key] = nullptr;
    object[reason_key(key)] = reason(value);
  }
}

std::string_view name_of(RunStatus status) {
  for (const auto& [value, name] : status_names) {
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

/// An object of the file, with its place in it for the messages.
class Object {
 public:
  Object(const std::filesystem::path& file, std::string place, const Json& json)
      : file_(file), place_(std::move(place)), json_(json) {
    if (!json.is_object()) fail("must be an object", json);
  }

  const Json& at(const std::string& key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) throw ReadError(file_, fmt::format("key '{}' is missing", place_of(key)));
    return *found;
  }
  bool has(const std::string& key) const { return json_.contains(key); }
  Object object(const std::string& key) const { return {file_, place_of(key), at(key)}; }
  std::vector<Object> objects(const std::string& key) const {
    const auto& value = at(key);
    if (!value.is_array()) fail(key, "must be a list of objects", value);
    std::vector<Object> result;
    for (std::size_t i = 0; i < value.size(); ++i)
      result.push_back({file_, fmt::format("{}[{}]", place_of(key), i), value[i]});
    return result;
  }

  std::string text(const std::string& key) const {
    const auto& value = at(key);
    if (!value.is_string()) fail(key, "must be a string", value);
    const auto text = value.get<std::string>();
    if (printable_lines(text) != text) fail(key, "must be text without control characters", value);
    return text;
  }

  std::vector<std::string> texts(const std::string& key) const {
    const auto& value = at(key);
    std::vector<std::string> result;
    if (!value.is_array()) fail(key, "must be a list of strings", value);
    for (const auto& item : value) {
      if (!item.is_string()) fail(key, "must be a list of strings", item);
      result.push_back(item.get<std::string>());
    }
    return result;
  }

  std::vector<double> numbers(const std::string& key) const {
    const auto& value = at(key);
    std::vector<double> result;
    if (!value.is_array()) fail(key, "must be a list of numbers", value);
    for (const auto& item : value) {
      if (!item.is_number()) fail(key, "must be a list of numbers", item);
      result.push_back(item.get<double>());
    }
    return result;
  }

  bool truth(const std::string& key) const {
    const auto& value = at(key);
    if (!value.is_boolean()) fail(key, "must be true or false", value);
    return value.get<bool>();
  }

  template <std::integral Integer>
  Integer integer(const std::string& key) const {
    const auto& value = at(key);
    const bool fits = value.is_number_integer() && value.get<double>() >= 0 &&
                      value.get<double>() <= 0.5 * static_cast<double>(std::numeric_limits<Integer>::max());
    if (!fits) fail(key, "must be a whole number, not negative", value);
    return value.get<Integer>();
  }

  double number(const std::string& key) const {
    const auto& value = at(key);
    if (value.is_number()) return value.get<double>();
    if (!value.is_null()) fail(key, "must be a number or null", value);
    const auto why = text(reason_key(key));
    for (const auto& [infinite, name] : infinite_reasons) {
      if (why == name) return infinite;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::pair<double, double> position(const std::string& key) const {
    const auto& value = at(key);
    const bool valid = value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
    if (!valid) fail(key, "must be two numbers, [x, y]", value);
    return {value[0].get<double>(), value[1].get<double>()};
  }

  std::vector<std::string> keys() const {
    std::vector<std::string> result;
    for (const auto& entry : json_.items()) {
      if (!control_character(entry.key()).empty())
        fail("a key must not hold control characters", Json(entry.key()));
      result.push_back(entry.key());
    }
    return result;
  }

  /// Whether the key is the reason of a null beside it.
  bool is_reason(const std::string& key) const {
    for (const auto& entry : json_.items()) {
      if (entry.value().is_null() && key == reason_key(entry.key())) return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& key, std::string_view rule, const Json& value) const {
    Object::fail(file_, place_of(key), rule, value);
  }

 private:
  [[noreturn]] void fail(std::string_view rule, const Json& value) const { fail(file_, place_, rule, value); }
  [[noreturn]] static void fail(const std::filesystem::path& file, const std::string& place,
                                std::string_view rule, const Json& value) {
    throw ReadError(file, fmt::format("{}: {}, not {}", place.empty() ? "the file" : "key '" + place + "'",
                                      rule, value.is_structured() ? value.type_name() : value.dump()));
  }
  std::string place_of(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }

  const std::filesystem::path& file_;
  std::string place_;
  const Json& json_;
};

RunStatus status_from(const Object& json) {
  const auto text = json.text("status");
  for (const auto& [status, name] : status_names) {
    if (text == name) return status;
  }
  json.fail("status", "must be completed, equilibrium, unstable or interrupted", json.at("status"));
}

Summary::Probe probe_from(const Object& json) {
  Summary::Probe probe;
  std::tie(probe.x, probe.y) = json.position("position");
  const auto values = json.object("values");
  for (const auto& quantity : values.keys()) {
    if (!values.is_reason(quantity)) probe.values[quantity] = values.number(quantity);
  }
  return probe;
}

std::map<std::string, Summary::Probe> probes_from(const Object& json) {
  std::map<std::string, Summary::Probe> probes;
  for (const auto& name : json.keys()) probes[name] = probe_from(json.object(name));
  return probes;
}

std::map<std::string, Summary::Footing> footings_from(const Object& json) {
  std::map<std::string, Summary::Footing> footings;
  if (!json.has("footings")) return footings;
  const Object all = json.object("footings");
  for (const auto& name : all.keys()) {
    const Object f = all.object(name);
    footings[name] = {.force = f.number("force"),
                      .shear = f.number("shear"),
                      .settlement = f.number("settlement"),
                      .width = f.number("width")};
  }
  return footings;
}

std::map<std::string, Summary::Sheet> sheets_from(const Object& json) {
  std::map<std::string, Summary::Sheet> sheets;
  if (!json.has("sheets")) return sheets;
  const Object all = json.object("sheets");
  for (const auto& name : all.keys()) {
    const Object s = all.object(name);
    sheets[name] = {.moment = s.number("moment"),
                    .shear = s.number("shear"),
                    .axial = s.number("axial"),
                    .displacement = s.number("displacement")};
  }
  return sheets;
}

Summary::Safety safety_from(const Object& json) {
  return {.stable_at = json.number("stable_at"),
          .fails_at = json.number("fails_at"),
          .limit_equilibrium = json.has("limit_equilibrium") ? json.number("limit_equilibrium") : 0,
          .note = json.has("note") ? json.text("note") : ""};
}

Summary::Stage stage_from(const Object& json) {
  return {.name = json.text("name"),
          .ended = json.text("ended"),
          .start = json.number("start"),
          .time = json.number("time"),
          .steps = json.integer<std::int64_t>("steps"),
          .particles = json.integer<std::int64_t>("particles"),
          .unbalanced_force_ratio = json.number("unbalanced_force_ratio"),
          .largest_displacement = json.number("largest_displacement"),
          .probes = probes_from(json.object("probes")),
          .footings = footings_from(json),
          .sheets = sheets_from(json),
          .safety = json.has("safety") ? std::optional(safety_from(json.object("safety"))) : std::nullopt};
}

std::map<std::string, ErrorNorms> errors_from(const Object& json) {
  std::map<std::string, ErrorNorms> errors;
  for (const auto& field : json.keys()) {
    const Object norms = json.object(field);
    errors[field] = {norms.number("relative_l2"), norms.number("max_abs")};
  }
  return errors;
}

Summary::EnergyBudget energy_from(const Object& e) {
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

Summary::Zigzag zigzag_from(const Object& json) {
  return {json.number("rms"), json.number("quantile_99"), json.number("largest"), json.number("x"),
          json.number("y")};
}

Summary::Seepage seepage_from(const Object& json) {
  Summary::Seepage seepage{json.numbers("through_faces"), json.number("imbalance"),
                           json.integer<int>("newton_steps"), json.integer<int>("krylov_iterations")};
  if (!json.has("sections")) return seepage;
  const Object sections = json.object("sections");
  for (const auto& name : sections.keys()) seepage.sections[name] = sections.number(name);
  return seepage;
}

Summary::TransientSeepage transient_seepage_from(const Object& json) {
  const auto count = [&](const char* key) { return json.integer<std::int64_t>(key); };
  return {count("flow_steps"),        count("refused_steps"), count("newton_steps"),
          count("krylov_iterations"), count("soil_sweeps"),   json.number("entered"),
          json.number("left"),        json.number("gained"),  json.number("imbalance")};
}

Summary::Consolidation consolidation_from(const Object& json) {
  const auto count = [&](const char* key) { return json.integer<std::int64_t>(key); };
  return {count("flow_steps"),  count("pressure_solves"), count("krylov_iterations"),
          count("soil_sweeps"), json.number("drained"),   json.number("imbalance")};
}

Summary::WaterMotion motion_from(const Object& json) {
  const auto count = [&](const char* key) { return json.integer<std::int64_t>(key); };
  return {json.number("began"),   count("steps"),           count("krylov_iterations"), count("renewals"),
          json.number("drained"), json.number("imbalance"), json.number("misfit")};
}

Summary summary_from(const Object& json) {
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
  summary.formulation = json.text("formulation");
  summary.kernel_correction = json.truth("kernel_correction");
  summary.unbalanced_force_ratio = json.number("unbalanced_force_ratio");
  summary.energy_growth = json.number("energy_growth");
  summary.probes = probes_from(json.object("probes"));
  summary.footings = footings_from(json);
  summary.sheets = sheets_from(json);
  if (json.has("stages"))
    for (const Object& stage : json.objects("stages")) summary.stages.push_back(stage_from(stage));
  if (json.has("errors")) summary.errors = errors_from(json.object("errors"));
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

void write_summary(const std::filesystem::path& file, const Summary& summary) {
  // A message may quote a path that is not UTF-8: better with a replacement character than lost.
  const auto text = to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace);
  write_file(file, text + "\n");
}

Summary read_summary(const std::filesystem::path& file) {
  const auto text = read_file(file);
  try {
    return summary_from(Object(file, "", Json::parse(text)));
  } catch (const Json::exception& error) {
    throw ReadError(file, error.what());
  }
}

}  // namespace porosph
