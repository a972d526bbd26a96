#include "solver/case/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

#include "solver/printable.hpp"

namespace porosph {
namespace {

constexpr toml::source_position after_the_file{std::numeric_limits<toml::source_index>::max(), 1};

bool is_within(std::string_view key, std::string_view outer) {
  if (!key.starts_with(outer)) return false;
  return outer.empty() || key.size() == outer.size() || key[outer.size()] == '.' || key[outer.size()] == '[';
}

std::string parent(const std::string& key) {
  const auto end = key.find_last_of(".[");
  return end == std::string::npos ? "" : key.substr(0, end);
}

std::string value_text(const toml::node* node) {
  if (!node || node->is_table() || node->is_array()) return "";
  if (const auto* number = node->as_floating_point()) return fmt::format(" = {}", number->get());
  if (const auto* text = node->as_string()) {
    constexpr std::size_t longest = 60;
    return text->get().size() > longest ? "" : fmt::format(" = \"{}\"", text->get());
  }
  std::ostringstream out;
  out << toml::node_view<const toml::node>(node);
  return " = " + out.str();
}

}  // namespace

std::string place(std::string_view file, toml::source_position at) {
  return fmt::format("{}:{}:{}", file, at.line, at.column);
}

/// The override that set this key, or else one that made the table around it.
const Override* Report::override_of(const std::string& key) const {
  const auto last = [&](auto&& is_it) {
    const auto found = std::find_if(overrides_.rbegin(), overrides_.rend(), is_it);
    return found == overrides_.rend() ? nullptr : &*found;
  };
  if (const Override* own = last([&](const Override& o) { return is_within(key, o.key); })) return own;
  for (std::string outer = key; !outer.empty(); outer = parent(outer)) {
    const auto node = root_.at_path(outer);
    if (!node) continue;
    if (node.node()->source().begin.line > 0) return nullptr;
    return last([&](const Override& o) { return is_within(o.key, outer); });
  }
  return nullptr;
}

void Report::add(const std::string& key, std::string_view message) {
  const Override* source = override_of(key);
  const std::string named =
      key.empty() ? "case" : printable(fmt::format("key '{}'{}", key, value_text(root_.at_path(key).node())));
  toml::source_position at{1, 1};
  for (std::string outer = key; !outer.empty(); outer = parent(outer)) {
    const auto found = root_.at_path(outer);
    if (!found || found.node()->source().begin.line == 0) continue;
    at = found.node()->source().begin;
    break;
  }
  if (source)
    errors_.push_back(
        {after_the_file, fmt::format("override '{}': {}: {}", printable(source->text), named, message)});
  else
    errors_.push_back({at, fmt::format("{}: {}: {}", place(file_, at), named, message)});
}

void Report::add(const std::string& key, std::string_view message, toml::source_position at) {
  if (at.line == 0 || override_of(key)) return add(key, message);
  errors_.push_back({at, fmt::format("{}: key '{}': {}", place(file_, at), printable(key), message)});
}

std::string Report::text() const {
  std::vector<Error> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Error& a, const Error& b) { return a.at < b.at; });
  constexpr std::size_t most = 100;
  std::string all;
  for (std::size_t i = 0; i < std::min(sorted.size(), most); ++i)
    all += (all.empty() ? "" : "\n") + sorted[i].text;
  if (sorted.size() > most) all += fmt::format("\n{}: and {} more errors", file_, sorted.size() - most);
  return all;
}

}  // namespace porosph
