#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "solver/case/case_file.hpp"
#include "solver/case/change_settings.hpp"
#include "solver/case/check_case.hpp"
#include "solver/case/check_stages.hpp"
#include "solver/case/fields.hpp"
#include "solver/case/nearest.hpp"
#include "solver/case/overrides.hpp"
#include "solver/case/report.hpp"
#include "solver/case/units.hpp"
#include "solver/printable.hpp"

namespace porosph {
namespace {

constexpr std::uintmax_t largest_file = 16 << 20;  // bytes
constexpr std::size_t most_points = 10000;         // of a polygon
constexpr std::size_t most_tables = 1000;          // of a list
constexpr std::size_t most_key_dots = 100;         // in a line

bool is_name(const std::string& text) {
  const auto is_allowed = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) || c == '_' || c == '-');
  };
  return !text.empty() && text.size() <= 40 && std::all_of(text.begin(), text.end(), is_allowed);
}

std::string quoted(std::span<const std::string_view> words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

/// Sets declared values from a table and reports what is wrong with them.
class Reader : public Fields {
 public:
  Reader(const toml::table& root, Report& report) : table_(&root), report_(report) {}

  void read(Case& scene) {
    declare(*this, scene);
    report_unknown();
  }
  bool lengths_are_right() const { return lengths_are_right_; }

  void number(const Key& key, double& value, const Range& range) override {
    if (const toml::node* node = find(key))
      if (const auto x = number_of(key, path(key), *node)) {
        if (range.contains(*x))
          value = *x;
        else
          fail(key, path(key), fmt::format("must be {}{}", range.text(), unit(key)));
      }
  }

  void number_or(const Key& key, double& value, const Range& range, std::string_view word,
                 bool& is_word) override {
    const toml::node* node = key.is_used ? table_->get(key.name) : nullptr;
    const auto given = node ? node->value<std::string>() : std::nullopt;
    if (!given || begins_as_number(*given)) return is_word = is_word && !node, number(key, value, range);
    known_.emplace_back(key.name);
    if (is_word = *given == word; !is_word)
      fail(key, path(key),
           fmt::format("must be a number {} or \"{}\"{}", range.text(), word,
                       did_you_mean(nearest(*given, {std::string(word)}))));
  }

  void numbers(const Key& key, std::vector<double>& values, const Range& range) override {
    const toml::array* items = array(key, "a list of numbers");
    if (!items) return;
    values.clear();
    for (std::size_t i = 0; i < items->size(); ++i) {
      const std::string at = fmt::format("{}[{}]", path(key), i);
      const auto x = number_of(key, at, *items->get(i));
      if (!x) continue;
      if (range.contains(*x))
        values.push_back(*x);
      else
        fail(key, at, fmt::format("must be {}{}", range.text(), unit(key)));
    }
  }

  void integer(const Key& key, int& value, const Range& range) override {
    const toml::node* node = find(key);
    if (!node) return;
    const auto x = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (x && range.contains(static_cast<double>(*x)))
      value = static_cast<int>(*x);
    else
      fail(key, path(key), fmt::format("must be a whole number {}", range.text()));
  }

  void flag(const Key& key, bool& value) override { scalar(key, value, "true or false"); }
  void flag_or(const Key& key, bool& value, std::string_view word, bool& is_word) override {
    const toml::node* node = find(key);
    if (!node) return;
    const auto given = node->value<std::string>();
    if (is_word = given == word; is_word) return;
    if (node->is_boolean())
      value = *node->value<bool>();
    else
      fail(key, path(key),
           fmt::format("must be true, false or \"{}\"{}", word,
                       did_you_mean(nearest(given.value_or(""), {std::string(word)}))));
  }
  void text(const Key& key, std::string& value) override {
    if (!scalar(key, value, "text")) return;
    if (const std::string control = control_character(value); !control.empty())
      fail(key, path(key), fmt::format("must not hold control characters, but has {}", control));
  }

  void name(const Key& key, std::string& value) override {
    std::string given;
    if (scalar(key, given, "text")) {
      if (is_name(given))
        value = given;
      else
        fail(key, path(key), "must be 1 to 40 letters (a-z, A-Z), digits, '_' or '-'");
    }
  }

  void words(const Key& key, std::vector<std::string>& values,
             std::span<const std::string> allowed) override {
    const toml::array* items = array(key, "a list of text");
    if (!items) return;
    values.clear();
    for (std::size_t i = 0; i < items->size(); ++i) {
      const std::string at = fmt::format("{}[{}]", path(key), i);
      const auto word = items->get(i)->value<std::string>();
      if (!word || std::find(allowed.begin(), allowed.end(), *word) == allowed.end()) {
        const std::string meant = nearest(word.value_or(""), {allowed.begin(), allowed.end()});
        fail(key, at, fmt::format("must be one of {}{}", fmt::join(allowed, ", "), did_you_mean(meant)));
      } else if (std::find(values.begin(), values.end(), *word) != values.end()) {
        fail(key, at, "is given twice");
      } else {
        values.push_back(*word);
      }
    }
  }

  void texts(const Key& key, std::vector<std::string>& values) override {
    const toml::array* items = array(key, "a list of text");
    if (!items) return;
    values.clear();
    for (std::size_t i = 0; i < items->size(); ++i) {
      const std::string at = fmt::format("{}[{}]", path(key), i);
      const auto word = items->get(i)->value<std::string>();
      if (!items->get(i)->is_string() || !word)
        fail(key, at, "must be text");
      else if (const std::string control = control_character(*word); !control.empty())
        fail(key, at, fmt::format("must not hold control characters, but has {}", control));
      else
        values.push_back(*word);
    }
  }

  void point(const Key& key, Point& value) override {
    if (const toml::node* node = find(key)) read_point(key, path(key), *node, value);
  }

  void pairs(const Key& key, std::vector<Point>& values) override {
    const toml::array* items = array(key, "a list of pairs");
    if (!items) return;
    if (items->size() < 2 || items->size() > most_points)
      return fail(key, path(key), fmt::format("must be a list of 2 to {} pairs", most_points));
    values.assign(items->size(), Point::Zero());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string at = fmt::format("{}[{}]", path(key), i);
      if (!read_point(key, at, *items->get(i), values[i])) return;
      if (i > 0 && values[i].x() <= values[i - 1].x())
        return fail(key, at, fmt::format("must come after {}", values[i - 1].x()));
    }
  }

  void polygon(const Key& key, Polygon& value) override {
    if (const toml::node* node = find(key)) read_polygon(key, path(key), *node, value);
  }

  void polygons(const Key& key, std::vector<Polygon>& values) override {
    const toml::array* items = array(key, "a list of polygons");
    if (!items) return;
    values.resize(items->size());
    for (std::size_t i = 0; i < items->size(); ++i)
      read_polygon(key, fmt::format("{}[{}]", path(key), i), *items->get(i), values[i]);
  }

  void set_defaults(const std::function<void()>& set) override { set(); }

  void reject(std::string_view key, const std::string& message) override {
    if (!failed_.empty()) return;  // a consequence, maybe
    report_.add(key.empty() ? path_ : path_ + "." + std::string(key), message);
    failed_.insert(std::string(key));
  }

 protected:
  void one_of(const Key& key, int& index, std::span<const std::string_view> names) override {
    const toml::node* node = find(key);
    if (!node) return;
    const auto word = node->value<std::string>();
    const auto found = std::find(names.begin(), names.end(), word.value_or(""));
    if (found == names.end())
      fail(key, path(key),
           fmt::format("must be one of {}{}", quoted(names),
                       did_you_mean(nearest(word.value_or(""), {names.begin(), names.end()}))));
    else
      index = static_cast<int>(found - names.begin());
  }

  void section(const Key& key, bool present, const std::function<void()>& contents) override {
    static const toml::table empty;
    const toml::node* node = find(key);
    if (!node && present) within(empty, path(key), contents);
    if (!node) return;
    if (const toml::table* table = node->as_table())
      within(*table, path(key), contents);
    else
      fail_table(key, path(key), fmt::format("must be a table: [{}]", key.name));
  }

  void list(const Key& key, std::size_t, const std::function<void(std::size_t)>& item) override {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array* items = node->as_array();
    if (!items || (key.is_required && items->empty()) || items->size() > most_tables)
      return fail_table(key, path(key),
                        fmt::format("must be a list of tables [[{}]], at most {}{}", key.name, most_tables,
                                    key.is_required ? ", at least one" : ""));
    for (std::size_t i = 0; i < items->size(); ++i) {
      const std::string at = fmt::format("{}[{}]", path(key), i);
      if (const toml::table* table = items->get(i)->as_table())
        within(*table, at, [&] { item(i); });
      else
        fail_table(key, at, "must be a table");
    }
  }

 private:
  std::string path(const Key& key) const {
    return path_ + (path_.empty() ? "" : ".") + std::string(key.name);
  }
  static std::string unit(const Key& key) { return key.unit.empty() ? "" : fmt::format(" {}", key.unit); }
  static std::string did_you_mean(const std::string& word) {
    return word.empty() ? "" : fmt::format("; did you mean '{}'?", word);
  }

  void fail(const Key& key, const std::string& at, const std::string& message) {
    report_.add(at, message);
    failed_.insert(std::string(key.name));
    if (key.unit == "m") lengths_are_right_ = false;
  }
  void fail_table(const Key& key, const std::string& at, const std::string& message) {
    fail(key, at, message);
    lengths_are_right_ = false;
  }

  const toml::node* find(const Key& key) {
    known_.emplace_back(key.name);
    const toml::node* node = table_->get(key.name);
    if (!node && key.is_required) fail(key, path(key), fmt::format("is missing: {}", key.meaning));
    if (node && !key.is_used) {  // unless the key that the condition begins with is wrong itself
      if (!failed_.contains(key.condition.substr(0, key.condition.find(' '))))
        fail(key, path(key), fmt::format("is used only with {}", key.condition));
      return nullptr;
    }
    return node;
  }

  const toml::array* array(const Key& key, std::string_view type) {
    const toml::node* node = find(key);
    if (node && !node->is_array()) fail(key, path(key), fmt::format("must be {}", type));
    return node ? node->as_array() : nullptr;
  }

  template <class T>
  bool scalar(const Key& key, T& value, std::string_view type) {
    const toml::node* node = find(key);
    if (!node) return false;
    const auto given = node->is<T>() ? node->value<T>() : std::nullopt;
    if (given)
      value = *given;
    else
      fail(key, path(key), fmt::format("must be {}", type));
    return given.has_value();
  }

  // A number in `unit`, or text with a number and a unit of its own that is converted.
  std::optional<double> number_of(const Key& key, const std::string& at, const toml::node& node) {
    return number_of(key, at, node, key.unit);
  }
  std::optional<double> number_of(const Key& key, const std::string& at, const toml::node& node,
                                  std::string_view unit) {
    const auto text = node.value_exact<std::string>();
    const Measure given =
        node.is_number() ? Measure{*node.value<double>(), ""} : read_measure(text.value_or(""), unit);
    if (!given.fault.empty())
      fail(key, at, given.fault);
    else if (!std::isfinite(given.value))
      fail(key, at, "must be finite");
    else
      return given.value;
    return std::nullopt;
  }

  bool read_point(const Key& key, const std::string& at, const toml::node& node, Point& value) {
    const toml::array* xy = node.as_array();
    if (!xy || xy->size() != 2) {
      fail(key, at, fmt::format("must be two numbers [x, y] in{}", unit(key)));
      return false;
    }
    for (int i = 0; i < 2; ++i) {
      const std::string here = fmt::format("{}[{}]", at, i);
      const std::string_view unit = unit_of_component(key.unit, i);
      const auto x = number_of(key, here, (*xy)[static_cast<std::size_t>(i)], unit);
      if (!x) return false;
      const Range range = between(-farthest, farthest);
      if (!range.contains(*x))
        return fail(key, here, fmt::format("must be {} {}", range.text(), unit)), false;
      value[i] = *x;
    }
    return true;
  }

  void read_polygon(const Key& key, const std::string& at, const toml::node& node, Polygon& value) {
    const toml::array* points = node.as_array();
    if (!points || points->size() < 3 || points->size() > most_points)
      return fail(key, at, fmt::format("must be a list of 3 to {} points [x, y]", most_points));
    value.assign(points->size(), Point::Zero());
    for (std::size_t i = 0; i < value.size(); ++i)
      if (!read_point(key, fmt::format("{}[{}]", at, i), *points->get(i), value[i])) return;
  }

  // Reads the contents of an inner table, then comes back to this one.
  void within(const toml::table& inner, const std::string& at, const std::function<void()>& contents) {
    const toml::table* outer = std::exchange(table_, &inner);
    std::string outer_path = std::exchange(path_, at);
    auto outer_known = std::exchange(known_, {});
    auto outer_failed = std::exchange(failed_, {});
    contents();
    report_unknown();
    table_ = outer;
    path_ = std::move(outer_path);
    known_ = std::move(outer_known);
    failed_ = std::move(outer_failed);
  }

  void report_unknown() {
    for (const auto& [key, node] : *table_) {
      const std::string word(key.str());
      if (std::find(known_.begin(), known_.end(), word) != known_.end()) continue;
      const std::string meant = nearest(word, known_);
      report_.add(path_ + (path_.empty() ? "" : ".") + word,
                  "is not known" + (meant.empty() ? fmt::format("; known are {}", fmt::join(known_, ", "))
                                                  : did_you_mean(meant)),
                  key.source().begin);
    }
  }

  const toml::table* table_;
  Report& report_;
  std::string path_;                // of table_
  std::vector<std::string> known_;  // keys of table_ declared so far
  std::set<std::string> failed_;    // keys of table_ that are wrong
  bool lengths_are_right_ = true;
};

// Counts the dots that are not decimal points: at least all those between the names of dotted keys.
std::size_t key_dots(std::string_view line) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_word = [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '+' || c == '.';
  };
  std::size_t total = 0;
  for (auto word = line.begin(); word != line.end();) {
    const auto end = std::find_if_not(word, line.end(), is_word);
    const auto dots = static_cast<std::size_t>(std::count(word, end, '.'));
    const auto dot = std::find(word, end, '.');
    const bool decimal = dots == 1 && dot != word && is_digit(dot[-1]) && dot + 1 != end && is_digit(dot[1]);
    if (!decimal) total += dots;
    word = std::find_if(end, line.end(), is_word);
  }
  return total;
}

// toml++ handles tables within tables by recursion, and would use up the stack.
void check_depth(std::string_view text, std::string_view file_name) {
  toml::source_position at{1, 1};
  for (; !text.empty(); ++at.line) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (!line.starts_with('#') && key_dots(line) > most_key_dots)
      throw CaseError(fmt::format("{}: more than {} dots in a line: keys are not nested so deeply",
                                  place(file_name, at), most_key_dots));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
}

toml::table parse_toml(std::string_view text, std::string_view file_name) {
  check_depth(text, file_name);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw CaseError(fmt::format("{}: {}", place(file_name, error.source().begin), error.description()));
  }
}

}  // namespace

Case parse_case(std::string_view text, std::string_view file_name,
                const std::vector<std::string>& overrides) {
  if (text.size() > largest_file)
    throw CaseError(
        fmt::format("{}: has {} bytes; at most {} are read", file_name, text.size(), largest_file));
  toml::table root = parse_toml(text, file_name);
  std::vector<std::string> wrong_overrides;
  const std::vector<Override> applied = apply_overrides(root, overrides, wrong_overrides);

  Case scene;
  Report report(file_name, root, applied);
  Reader reader(root, report);
  reader.read(scene);
  for (const CaseIssue& issue : check_settings(scene)) report.add(issue.key, issue.message);
  if (reader.lengths_are_right() && scene.stages.empty())
    for (const CaseIssue& issue : check_geometry(scene)) report.add(issue.key, issue.message);
  if (!scene.stages.empty() && report.size() == 0)
    for (const CaseIssue& issue : check_stages(scene)) report.add(issue.key, issue.message);

  std::string errors = report.text();
  for (const std::string& error : wrong_overrides) errors += (errors.empty() ? "" : "\n") + error;
  if (!errors.empty()) throw CaseError(errors);
  return scene;
}

/// Of the ways to give the water its level only the one that is set now counts.
static void leave_one_level(toml::table& root, const std::vector<Override>& applied) {
  static const std::vector<std::string> ways = {"level", "stretches", "level_over_time"};
  toml::table* water = root.get_as<toml::table>("water");
  for (const Override& o : applied)
    for (const std::string& way : ways)
      if (water != nullptr && o.key == "water." + way)
        for (const std::string& other : ways)
          if (other != way) water->erase(other);
}

/// Without gravity there are no keys of what it does.
static void leave_out_weight(toml::table& root) {
  toml::table* loading = root.get_as<toml::table>("loading");
  if (loading == nullptr || (*loading)["gravity_applied"].value<bool>() != false) return;
  for (const char* key : {"k0_stress", "k0", "horizontal"}) loading->erase(key);
}

Case with_settings(const Case& scene, const std::vector<std::string>& settings,
                   std::vector<SettingFault>& faults) {
  toml::table root = toml::parse(write_case(scene));
  std::vector<std::string> wrong;
  const std::vector<Override> applied = apply_overrides(root, settings, wrong);
  leave_one_level(root, applied);
  leave_out_weight(root);
  Case changed;
  Report report("the case with this stage", root, applied);
  Reader(root, report).read(changed);
  for (const CaseIssue& issue : check_settings(changed)) report.add(issue.key, issue.message);
  std::istringstream lines(report.text());
  for (std::string line; std::getline(lines, line);) wrong.push_back(line);
  for (const std::string& line :
       wrong) {  // each begins with the setting that it is about, if it is about one
    SettingFault fault{-1, line};
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const std::string head = fmt::format("override '{}': ", printable(settings[i]));
      if (line.starts_with(head)) fault = {static_cast<int>(i), line.substr(head.size())};
    }
    faults.push_back(std::move(fault));
  }
  return changed;
}

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw CaseError(fmt::format("{}: is not a readable file{}", name, error ? ": " + error.message() : ""));
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > largest_file)
    throw CaseError(fmt::format("{}: has {} bytes; at most {} are read", name, size, largest_file));
  std::ifstream stream(file, std::ios::binary);
  std::string text(error ? 0 : size, '\0');
  if (error || !stream.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw CaseError(fmt::format("{}: cannot be read", name));
  return parse_case(text, name, overrides);
}

}  // namespace porosph
