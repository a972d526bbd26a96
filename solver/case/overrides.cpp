#include "solver/case/overrides.hpp"

#include <fmt/format.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <charconv>
#include <stdexcept>

namespace porosph {
namespace {

// Returns a table that holds the value as "value". Text that is not TOML is a bare word, unless it looks like
// unfinished TOML.
toml::table parse_value(const std::string& text) {
  if (text.find_first_of("\r\n") != std::string::npos) throw std::runtime_error("the value must be one line");
  try {
    return toml::parse("value = " + text);
  } catch (const toml::parse_error& error) {
    if (text.empty() || text.find_first_of("[]{}\"'=#") != std::string::npos)
      throw std::runtime_error(fmt::format("the value is not TOML: {}", error.description()));
    return toml::table{{"value", text}};
  }
}

std::string names_of(const toml::array& tables) {
  std::string names;
  for (const toml::node& node : tables)
    if (const auto* table = node.as_table())
      names += fmt::format("{}'{}'", names.empty() ? "" : ", ", (*table)["name"].value_or<std::string>("?"));
  return names.empty() ? "none" : names;
}

// The table of a list that `which` names, by its "name" or its number from 0.
std::size_t find_table(const toml::array& tables, const std::string& list, const std::string& which) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    if (const auto* table = tables[i].as_table(); table && (*table)["name"].value<std::string>() == which)
      return i;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(which.data(), which.data() + which.size(), index);
  if (error == std::errc{} && end == which.data() + which.size() && index < tables.size()) return index;
  throw std::runtime_error(
      fmt::format("there is no {} '{}'; the case has {}", list, which, names_of(tables)));
}

Override apply(toml::table& root, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) throw std::runtime_error("must be key=value");
  const std::string key = boost::trim_copy(text.substr(0, equals));
  toml::table value = parse_value(boost::trim_copy(text.substr(equals + 1)));

  std::vector<std::string> steps;
  boost::split(steps, key, boost::is_any_of("."));
  for (const std::string& step : steps)
    if (step.empty()) throw std::runtime_error("the key must be a dotted path, as particles.spacing");

  if (steps.size() > 10) throw std::runtime_error("the key is nested deeper than any");

  toml::table* table = &root;
  std::string path;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    path += (path.empty() ? "" : ".") + steps[i];
    if (!table->contains(steps[i])) table->insert(steps[i], toml::table{});
    toml::node& next = *table->get(steps[i]);
    if (toml::array* tables = next.as_array()) {
      if (i + 2 >= steps.size())
        throw std::runtime_error(fmt::format("'{}' is a list: name one of it ({})", path, names_of(*tables)));
      const std::size_t index = find_table(*tables, steps[i], steps[i + 1]);
      path += fmt::format("[{}]", index);
      table = tables->get(index)->as_table();
      ++i;
    } else {
      table = next.as_table();
    }
    if (!table) throw std::runtime_error(fmt::format("'{}' is not a table", path));
  }
  path += (path.empty() ? "" : ".") + steps.back();
  std::move(value).get("value")->visit(
      [&](auto& node) { table->insert_or_assign(steps.back(), std::move(node)); });
  return {path, text};
}

}  // namespace

std::vector<Override> apply_overrides(toml::table& root, const std::vector<std::string>& overrides,
                                      std::vector<std::string>& errors) {
  std::vector<Override> applied;
  for (const std::string& text : overrides) {
    try {
      applied.push_back(apply(root, text));
    } catch (const std::runtime_error& error) {
      errors.push_back(fmt::format("override '{}': {}", text, error.what()));
    }
  }
  return applied;
}

}  // namespace porosph
