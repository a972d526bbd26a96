#include "render/report/settings.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "solver/case/case_file.hpp"

namespace porosph::render {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

bool is_list_of_tables(const toml::node& node) {
  return node.is_array() && !node.as_array()->empty() && node.as_array()->get(0)->is_table();
}

/// On one line. (toml++ may break long arrays, and rounds their width past what an integer holds.)
std::string text_of(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> items;
    for (const toml::node& item : *array) items.push_back(text_of(item));
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

void collect(const toml::node& node, const std::string& path, Settings& out) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      collect(value, path.empty() ? std::string(key.str()) : path + "." + std::string(key.str()), out);
  } else if (is_list_of_tables(node)) {
    for (std::size_t i = 0; i < node.as_array()->size(); ++i)
      collect(*node.as_array()->get(i), fmt::format("{}.{}", path, i), out);
  } else {
    out.emplace_back(path, text_of(node));
  }
}

}  // namespace

Settings settings_of(const Case& scene) {
  Settings out;
  collect(toml::parse(write_case(scene)), "", out);
  return out;
}

std::vector<DifferingSetting> differing_settings(const std::vector<Case>& scenes) {
  std::vector<DifferingSetting> all;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (const auto& [key, value] : settings_of(scenes[i])) {
      auto found = std::find_if(all.begin(), all.end(), [&key = key](const auto& d) { return d.key == key; });
      if (found == all.end()) found = all.insert(all.end(), {key, std::vector<std::string>(scenes.size())});
      found->values[i] = value;
    }
  std::erase_if(all, [](const DifferingSetting& d) {
    return std::all_of(d.values.begin(), d.values.end(),
                       [&](const auto& v) { return v == d.values.front(); });
  });
  return all;
}

}  // namespace porosph::render
