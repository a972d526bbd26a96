#include "vtk_io/run_folder/fem_check_json.hpp"

#include <cmath>
#include <limits>

namespace porosph {
namespace {

using Json = nlohmann::ordered_json;

void put(Json& object, const std::string& key, double value, const char* reason) {
  if (std::isfinite(value)) {
    object[key] = value;
  } else {
    object[key] = nullptr;
    object[key + "_reason"] = reason;
  }
}

double number(const Json& object, const std::string& key) {
  const Json& value = object.at(key);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Json to_json(const FemDifference& d) {
  Json json;
  put(json, "relative_l2", d.relative_l2, "finite elements have none");
  put(json, "relative", d.relative, "not a number");
  put(json, "max_abs", d.max_abs, "not a number");
  json["where"] = Json::array({d.x, d.y});
  put(json, "local", d.local, "not a number");
  json["local_where"] = Json::array({d.local_x, d.local_y});
  return json;
}

Json to_json(const FemSoilCheck& soil) {
  Json json = {{"particles", soil.particles}, {"left_out", soil.left_out}};
  put(json, "strain", soil.strain, "not a number");
  json["fields"] = Json::object();
  for (const auto& [name, difference] : soil.fields) json["fields"][name] = to_json(difference);
  return json;
}

FemSoilCheck soil_from(const Json& json) {
  FemSoilCheck soil{json.at("particles").get<std::int64_t>(),
                    json.at("left_out").get<std::int64_t>(),
                    number(json, "strain"),
                    {}};
  for (const auto& [name, d] : json.at("fields").items()) {
    FemDifference& found = soil.fields[name] = {.relative_l2 = number(d, "relative_l2"),
                                                .relative = number(d, "relative"),
                                                .max_abs = number(d, "max_abs"),
                                                .x = d.at("where").at(0).get<double>(),
                                                .y = d.at("where").at(1).get<double>()};
    if (!d.contains("local")) continue;  // older runs
    found.local = number(d, "local");
    found.local_x = d.at("local_where").at(0).get<double>();
    found.local_y = d.at("local_where").at(1).get<double>();
  }
  return soil;
}

}  // namespace

Json to_json(const FemCheck& check) {
  if (!check.skipped.empty()) return {{"skipped", check.skipped}, {"warnings", check.warnings}};
  Json json = {{"unknowns", check.unknowns},
               {"seconds", check.seconds},
               {"limit", check.limit},
               {"local_limit", check.local_limit}};
  json["soils"] = Json::object();
  for (const auto& [name, soil] : check.soils) json["soils"][name] = to_json(soil);
  for (const auto& [probe, values] : check.probes) json["probes"][probe] = values;
  json["warnings"] = check.warnings;
  return json;
}

FemCheck fem_check_from(const Json& json) {
  FemCheck check;
  check.warnings = json.at("warnings").get<std::vector<std::string>>();
  if (json.contains("skipped")) {
    check.skipped = json.at("skipped").get<std::string>();
    return check;
  }
  check.unknowns = number(json, "unknowns");
  check.seconds = number(json, "seconds");
  check.limit = number(json, "limit");
  if (json.contains("local_limit")) check.local_limit = number(json, "local_limit");
  for (const auto& [name, soil] : json.at("soils").items()) check.soils[name] = soil_from(soil);
  if (json.contains("probes")) check.probes = json.at("probes").get<decltype(check.probes)>();
  return check;
}

}  // namespace porosph
