#include "app/case_schema.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "solver/case/fields.hpp"
#include "solver/case/units.hpp"

namespace porosph::app {
namespace {

using Json = nlohmann::ordered_json;

Json bounded(Json schema, const Range& range) {
  if (std::isfinite(range.min)) schema[range.min_included ? "minimum" : "exclusiveMinimum"] = range.min;
  if (std::isfinite(range.max)) schema[range.max_included ? "maximum" : "exclusiveMaximum"] = range.max;
  return schema;
}

/// A number, or text of a number and one of the usual units of the key.
Json measure(std::string_view unit, const Range& range = {}) {
  std::string units = usual_units(unit);
  for (std::size_t at = 0; (at = units.find(", ", at)) != std::string::npos;) units.replace(at, 2, "|");
  return bounded(
      {{"type", {"number", "string"}}, {"pattern", "^[-+]?[0-9.]+([eE][-+]?[0-9]+)? *(" + units + ")$"}},
      range);
}

Json list_of(Json items, int least = 0, int most = -1) {
  Json schema = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) schema["minItems"] = least;
  if (most >= 0) schema["maxItems"] = most;
  return schema;
}

template <class Words>
Json one_word_of(const Words& words) {
  Json schema = {{"enum", Json::array()}};
  for (const auto& word : words) schema["enum"].push_back(std::string(word));
  return schema;
}

/// Collects the schema of one table of keys after the other.
class SchemaWriter : public Fields {
 public:
  Json table = empty_table();

  void number(const Key& key, double& value, const Range& range) override {
    add(key, measure(key.unit, range), std::isfinite(value) ? Json(value) : Json());
  }
  void number_or(const Key& key, double&, const Range& range, std::string_view word, bool&) override {
    add(key, {{"anyOf", {measure(key.unit, range), {{"const", std::string(word)}}}}});
  }
  void numbers(const Key& key, std::vector<double>&, const Range& range) override {
    add(key, list_of(measure(key.unit, range)));
  }
  void integer(const Key& key, int& value, const Range& range) override {
    add(key, bounded({{"type", "integer"}}, range), value);
  }
  void flag(const Key& key, bool& value) override { add(key, {{"type", "boolean"}}, value); }
  void flag_or(const Key& key, bool&, std::string_view word, bool&) override {
    add(key, {{"anyOf", {{{"type", "boolean"}}, {{"const", std::string(word)}}}}});
  }
  void text(const Key& key, std::string&) override { add(key, {{"type", "string"}}); }
  void name(const Key& key, std::string&) override {
    add(key, {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]+$"}});
  }
  void words(const Key& key, std::vector<std::string>&, std::span<const std::string> allowed) override {
    add(key, list_of(one_word_of(allowed)));
  }
  void texts(const Key& key, std::vector<std::string>&) override { add(key, list_of({{"type", "string"}})); }
  void point(const Key& key, Point&) override { add(key, pair(key)); }
  void pairs(const Key& key, std::vector<Point>&) override { add(key, list_of(pair(key))); }
  void polygon(const Key& key, Polygon&) override { add(key, list_of(pair(key), 3)); }
  void polygons(const Key& key, std::vector<Polygon>&) override { add(key, list_of(list_of(pair(key), 3))); }

 protected:
  void one_of(const Key& key, int& index, std::span<const std::string_view> names) override {
    const bool has_default = index >= 0 && static_cast<std::size_t>(index) < names.size();
    add(key, one_word_of(names),
        has_default ? Json(std::string(names[static_cast<std::size_t>(index)])) : Json());
  }
  void section(const Key& key, bool, const std::function<void()>& contents) override {
    add(key, within(contents));
  }
  void list(const Key& key, std::size_t, const std::function<void(std::size_t)>& item) override {
    add(key, list_of(within([&] { item(0); })));
  }

 private:
  static Json empty_table() {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  }
  static Json pair(const Key& key) {
    const std::string_view first = unit_of_component(key.unit, 0), second = unit_of_component(key.unit, 1);
    if (first == second) return list_of(measure(first), 2, 2);
    return list_of({measure(first), measure(second)}, 2, 2);  // one schema for each of them
  }

  Json within(const std::function<void()>& contents) {
    Json outer = std::exchange(table, empty_table());
    contents();
    return std::exchange(table, std::move(outer));
  }

  void add(const Key& key, Json schema, const Json& value = {}) {
    std::string text(key.meaning);
    if (!key.unit.empty() && key.unit != "-") text += " [" + std::string(key.unit) + "]";
    if (!key.condition.empty()) text += " Only if " + key.condition + ".";
    if (!key.fallback.empty()) text += " Default: " + key.fallback + ".";
    schema["description"] = text;
    const bool must_be_given = key.is_required && key.condition.empty();
    if (!key.is_required && key.fallback.empty() && !value.is_null()) schema["default"] = value;
    table["properties"][std::string(key.name)] = std::move(schema);
    if (must_be_given) table["required"].push_back(std::string(key.name));
  }
};

}  // namespace

Json case_schema() {
  SchemaWriter writer;
  Case defaults;
  declare(writer, defaults);
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Case of Porosph"}};
  schema.update(writer.table);
  return schema;
}

}  // namespace porosph::app
