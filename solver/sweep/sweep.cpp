#include "solver/sweep/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <array>
#include <boost/algorithm/string/trim.hpp>
#include <fstream>
#include <sstream>

#include "solver/case/case_file.hpp"
#include "solver/printable.hpp"

namespace porosph {
namespace {

namespace fs = std::filesystem;
constexpr std::array<std::string_view, 4> references = {"case", "weight_above", "fem", "energy"};

/// Reads the tables of a sweep file; every complaint names the place.
class SweepReader {
 public:
  SweepReader(fs::path file, bool quick) : file_(std::move(file)), quick_(quick) {}

  Sweep read() const {
    const toml::table root = parsed();
    only(root, {"title", "case", "set", "reference", "accurate_below", "settled_below", "notes", "x", "y"},
         "");
    Sweep sweep;
    sweep.name = file_.stem().string();
    sweep.title = text(root, "title");
    sweep.case_file = file_.parent_path() / text(root, "case");
    sweep.settings = texts(root, "set");
    sweep.notes = texts(root, "notes");
    if (root.contains("reference")) sweep.reference = reference(root);
    sweep.limits.accurate = number(root, "accurate_below", sweep.limits.accurate);
    sweep.limits.settled = number(root, "settled_below", sweep.limits.settled);
    sweep.x = axis(root, "x");
    sweep.y = root.contains("y") ? axis(root, "y") : SweepAxis{"", {{"", {}}}};
    return sweep;
  }

 private:
  [[noreturn]] void fail(const toml::node& at, std::string_view key, const std::string& what) const {
    const toml::source_position place = at.source().begin;
    throw CaseError(
        fmt::format("{}:{}:{}: key '{}': {}", file_.string(), place.line, place.column, key, what));
  }

  toml::table parsed() const {
    std::ifstream stream(file_, std::ios::binary);
    std::ostringstream content;
    if (!fs::is_regular_file(file_) || !(content << stream.rdbuf()))
      throw CaseError(fmt::format("{}: is not a readable file", file_.string()));
    try {
      return toml::parse(content.str(), file_.string());
    } catch (const toml::parse_error& error) {
      throw CaseError(fmt::format("{}:{}:{}: {}", file_.string(), error.source().begin.line,
                                  error.source().begin.column, error.description()));
    }
  }

  void only(const toml::table& table, std::initializer_list<std::string_view> keys,
            std::string_view path) const {
    for (const auto& [key, node] : table)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        fail(node, fmt::format("{}{}", path, key.str()),
             fmt::format("is unknown; allowed are {}", fmt::join(keys, ", ")));
  }

  std::string without_control(const toml::node& at, std::string_view key, const std::string& value) const {
    if (const std::string control = control_character(value); !control.empty())
      fail(at, key, fmt::format("must not hold control characters, but has {}", control));
    return value;
  }

  std::string text(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (!node) fail(table, key, "is missing");
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) fail(*node, key, "must be text");
    return without_control(*node, key, *value);
  }

  std::vector<std::string> texts(const toml::table& table, std::string_view key) const {
    std::vector<std::string> values;
    const toml::node* node = table.get(key);
    if (!node) return values;
    if (!node->is_array()) fail(*node, key, "must be a list of text");
    for (const toml::node& item : *node->as_array()) {
      const auto value = item.value_exact<std::string>();
      if (!value) fail(item, key, "must be a list of text");
      values.push_back(without_control(item, key, *value));
    }
    return values;
  }

  double number(const toml::table& table, std::string_view key, double otherwise) const {
    const toml::node* node = table.get(key);
    if (!node) return otherwise;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !(*value > 0 && *value < never)) fail(*node, key, "must be a number > 0");
    return *value;
  }

  SweepReference reference(const toml::table& root) const {
    try {
      return parse_reference(text(root, "reference"));
    } catch (const CaseError& error) {
      fail(*root.get("reference"), "reference", error.what());
    }
  }

  SweepAxis axis(const toml::table& root, std::string_view name) const {
    const toml::node* node = root.get(name);
    if (!node) fail(root, name, "is missing: what is varied");
    const toml::table* table = node->as_table();
    if (!table) fail(*node, name, "must be a table");
    only(*table, {"title", "key", "scale", "values", "quick"}, fmt::format("{}.", name));
    SweepAxis axis{text(*table, "title"), {}};
    const std::string_view chosen = quick_ && table->contains("quick") ? "quick" : "values";
    const toml::node* values = table->get(chosen);
    if (!values || !values->is_array() || values->as_array()->empty())
      fail(values ? *values : *node, fmt::format("{}.{}", name, chosen), "must be a list, not empty");
    for (const toml::node& item : *values->as_array()) axis.values.push_back(value(*table, item, name));
    return axis;
  }

  SweepValue value(const toml::table& axis, const toml::node& item, std::string_view name) const {
    if (const toml::table* table = item.as_table()) {
      only(*table, {"label", "set"}, fmt::format("{}.values.", name));
      return {text(*table, "label"), texts(*table, "set")};
    }
    const std::string key = text(axis, "key");
    if (const auto number =
            item.is_floating_point() || axis.contains("scale") ? item.value<double>() : std::nullopt)
      return {fmt::format("{}", *number),
              {fmt::format("{}={}", key, *number * this->number(axis, "scale", 1))}};
    std::ostringstream plain;
    item.visit([&](const auto& it) { plain << it; });
    const auto word = item.value_exact<std::string>();
    return {word ? *word : plain.str(), {key + "=" + plain.str()}};
  }

  fs::path file_;
  bool quick_;
};

/// Splits at commas outside of brackets and quotes.
std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    }
    if (c == ',' && depth == 0 && quote == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

std::vector<std::string> Sweep::settings_of(std::size_t i) const {
  std::vector<std::string> all = settings;
  for (const SweepValue* value : {&x.values[i % x.values.size()], &y.values[i / x.values.size()]})
    all.insert(all.end(), value->settings.begin(), value->settings.end());
  return all;
}

Sweep read_sweep(const fs::path& file, bool quick) { return SweepReader(file, quick).read(); }

SweepReference parse_reference(const std::string& name) {
  const auto found = std::find(references.begin(), references.end(), name);
  if (found == references.end())
    throw CaseError(fmt::format("must be one of {}", fmt::join(references, ", ")));
  return static_cast<SweepReference>(found - references.begin());
}

SweepAxis parse_axis(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw CaseError(fmt::format("--vary {}: must be key=value,value,...", text));
  SweepAxis axis{boost::trim_copy(text.substr(0, equals)), {}};
  for (const std::string& part : split_values(text.substr(equals + 1))) {
    const std::string value = boost::trim_copy(part);
    if (value.empty()) throw CaseError(fmt::format("--vary {}: a value is empty", text));
    axis.values.push_back({value, {axis.title + "=" + value}});
  }
  return axis;
}

}  // namespace porosph
