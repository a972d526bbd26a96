#include <set>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"
#include "solver/case/units.hpp"

namespace porosph {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string names(std::span<const std::string_view> words) {
  return fmt::format("`{}`", fmt::join(words, "`, `"));
}

/// Writes a Markdown table of the declared keys for each TOML table.
class Documenter : public Fields {
 public:
  std::string finished() { return head_ + table_ + inner_; }
  const std::set<std::string>& units() const { return units_; }
  explicit Documenter(std::string head) : head_(std::move(head)) {}

  void number(const Key& key, double& value, const Range& range) override {
    row(key, "number", fmt::to_string(value), range.text());
  }
  void number_or(const Key& key, double& value, const Range& range, std::string_view word, bool&) override {
    row(key, "number or text", fmt::to_string(value), fmt::format("{}; `{}`", range.text(), word));
  }
  void numbers(const Key& key, std::vector<double>&, const Range& range) override {
    row(key, "list of numbers", "[]", range.text());
  }
  void integer(const Key& key, int& value, const Range& range) override {
    row(key, "whole number", fmt::to_string(value), range.text());
  }
  void flag(const Key& key, bool& value) override {
    row(key, "truth", value ? "true" : "false", "`true`, `false`");
  }
  void flag_or(const Key& key, bool& value, std::string_view word, bool& is_word) override {
    row(key, "truth or text",
        is_word ? std::string(word)
        : value ? "true"
                : "false",
        fmt::format("`true`, `false`, `{}`", word));
  }
  void text(const Key& key, std::string&) override { row(key, "text", "\"\"", "any"); }
  void name(const Key& key, std::string&) override { row(key, "text", "", "letters, digits, `_`, `-`"); }
  void words(const Key& key, std::vector<std::string>& values,
             std::span<const std::string> allowed) override {
    row(key, "list of text", fmt::format("{}", fmt::join(values, ", ")),
        fmt::format("`{}`", fmt::join(allowed, "`, `")));
  }
  void texts(const Key& key, std::vector<std::string>&) override { row(key, "list of text", "[]", "any"); }
  void point(const Key& key, Point& value) override {
    row(key, "point", fmt::format("[{}, {}]", value.x(), value.y()), "[x, y]");
  }
  void pairs(const Key& key, std::vector<Point>&) override {
    row(key, "list of pairs", "", "[[t, y], ...], t increasing, 2 pairs or more");
  }
  void polygon(const Key& key, Polygon&) override {
    row(key, "polygon", "", "[[x, y], ...], 3 points or more");
  }
  void polygons(const Key& key, std::vector<Polygon>&) override {
    row(key, "list of polygons", "[]", "[[[x, y], ...], ...]");
  }

 protected:
  void one_of(const Key& key, int& index, std::span<const std::string_view> allowed) override {
    row(key, "text", std::string(allowed[static_cast<std::size_t>(index)]), names(allowed));
  }
  void section(const Key& key, bool, const std::function<void()>& contents) override {
    block(key, "[{}]", contents);
  }
  void list(const Key& key, std::size_t, const std::function<void(std::size_t)>& item) override {
    block(key, "[[{}]]", [&] { item(0); });
  }

 private:
  void row(const Key& key, std::string_view type, const std::string& value, const std::string& allowed) {
    if (table_.empty())
      table_ = "\n| key | type | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n";
    for (int i = 0; i < 2; ++i) units_.emplace(unit_of_component(key.unit, i));
    std::string otherwise = key.fallback.empty() ? code(value) : key.fallback;
    if (key.is_required) otherwise = "required";
    const std::string condition =
        key.condition.empty() ? "" : fmt::format(" Only with {}.", code(key.condition));
    table_ += fmt::format("| `{}` | {} | {} | {} | {} | {}{} |\n", key.name, type, key.unit, otherwise,
                          allowed, key.meaning, condition);
  }
  // A table of its own, set after the one that it is part of.
  void block(const Key& key, fmt::string_view header, const std::function<void()>& contents) {
    const std::string path = path_ + (path_.empty() ? "" : ".") + std::string(key.name);
    Documenter part(fmt::format("\n### `{}`\n\n{}{}\n", fmt::format(fmt::runtime(header), path), key.meaning,
                                key.is_required ? " Required." : ""));
    part.path_ = path;
    std::swap(part, *this);
    contents();
    std::swap(part, *this);
    inner_ += part.finished();
    units_.merge(part.units_);
  }

  std::string path_, head_, table_, inner_;
  std::set<std::string> units_;  // of all keys
};

/// What text may give in place of a number in each of these units.
std::string units_table(const std::set<std::string>& units) {
  std::string table =
      "\n### Units in text\n\n| unit of the key | units that its value may carry |\n|---|---|\n";
  for (const std::string& unit : units)
    if (unit != "-") table += fmt::format("| {} | {} |\n", unit.empty() ? "none" : unit, usual_units(unit));
  return table;
}

}  // namespace

std::string describe_case_format() {
  Documenter documenter("### Top level\n");
  Case defaults;
  declare(documenter, defaults);
  const std::string tables = documenter.finished();
  return tables + units_table(documenter.units());
}

}  // namespace porosph
