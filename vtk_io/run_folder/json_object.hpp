// An object of a JSON file, read with errors that name the file, the key and what is allowed.
#pragma once

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/printable.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {

using Json = nlohmann::ordered_json;

/// What stands in "<key>_reason" beside a null, for a number that is not finite.
struct NotFinite {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr std::array<std::pair<double, std::string_view>, 2> infinite{{
      {infinity, "plus infinity"},
      {-infinity, "minus infinity"},
  }};
  static constexpr std::string_view nan = "not a number";

  static std::string key(const std::string& of) { return of + "_reason"; }
};

/// An object of the file, with its place in it for the messages.
class JsonObject {
 public:
  JsonObject(const std::filesystem::path& file, std::string place, const Json& json)
      : file_(file), place_(std::move(place)), json_(json) {
    if (!json.is_object()) fail("must be an object", json);
  }

  const Json& at(const std::string& key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) throw ReadError(file_, fmt::format("key '{}' is missing", place_of(key)));
    return *found;
  }
  bool has(const std::string& key) const { return json_.contains(key); }
  JsonObject object(const std::string& key) const { return {file_, place_of(key), at(key)}; }
  std::vector<JsonObject> objects(const std::string& key) const {
    const auto& value = at(key);
    if (!value.is_array()) fail(key, "must be a list of objects", value);
    std::vector<JsonObject> result;
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
    const auto why = text(NotFinite::key(key));
    for (const auto& [infinite, name] : NotFinite::infinite) {
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
      if (entry.value().is_null() && key == NotFinite::key(entry.key())) return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& key, std::string_view rule, const Json& value) const {
    JsonObject::fail(file_, place_of(key), rule, value);
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

}  // namespace porosph
