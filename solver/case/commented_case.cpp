#include "solver/case/commented_case.hpp"

#include <toml++/toml.h>

#include <boost/algorithm/string.hpp>
#include <utility>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"
#include "solver/case/toml_text.hpp"

namespace porosph {
namespace {

constexpr std::size_t widest = 100;  // columns

std::string comment(const std::string& text) {
  std::vector<std::string> words;
  boost::split(words, text, boost::is_space(), boost::token_compress_on);
  std::string lines, line = "#";
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > widest) lines += line + "\n", line = "#";
    if (!word.empty()) line += " " + word;
  }
  return lines + line + "\n";
}

/// Writes declared values: those in a TOML table as they are, the others as comments.
class Explainer : public Fields {
 public:
  explicit Explainer(const toml::table& given) : table_(&given) {}
  std::string finished() const { return text_; }

  void number(const Key& key, double& value, const Range& range) override {
    const bool set = range.contains(value) && value < never;
    line(key, set ? toml_text(value) : "", range.text() == "any" ? "" : range.text());
  }
  void number_or(const Key& key, double& value, const Range& range, std::string_view word,
                 bool& is_word) override {
    line(key, is_word ? fmt::format("\"{}\"", word) : toml_text(value),
         fmt::format("{}, or \"{}\"", range.text(), word));
  }
  void numbers(const Key& key, std::vector<double>& values, const Range& range) override {
    line(key, toml_text(values), range.text());
  }
  void integer(const Key& key, int& value, const Range& range) override {
    line(key, fmt::to_string(value), range.text());
  }
  void flag(const Key& key, bool& value) override { line(key, value ? "true" : "false", "true or false"); }
  void flag_or(const Key& key, bool& value, std::string_view word, bool& is_word) override {
    line(key,
         is_word ? fmt::format("\"{}\"", word)
         : value ? "true"
                 : "false",
         fmt::format("true, false or \"{}\"", word));
  }
  void text(const Key& key, std::string& value) override { line(key, toml_text(value), ""); }
  void name(const Key& key, std::string& value) override { line(key, toml_text(value), ""); }
  void words(const Key& key, std::vector<std::string>& values,
             std::span<const std::string> allowed) override {
    line(key, toml_text(values), fmt::format("{}", fmt::join(allowed, ", ")));
  }
  void texts(const Key& key, std::vector<std::string>& values) override { line(key, toml_text(values), ""); }
  void point(const Key& key, Point& value) override {
    line(key, value.allFinite() ? toml_text(value) : "", "[x, y]");
  }
  void pairs(const Key& key, std::vector<Point>& values) override {
    line(key, values.empty() ? "" : toml_text(values), "[[a, b], ...]");
  }
  void polygon(const Key& key, Polygon& value) override { line(key, toml_text(value), "[[x, y], ...]"); }
  void polygons(const Key& key, std::vector<Polygon>& values) override {
    line(key, toml_text(values), "[[[x, y], ...], ...]");
  }

 protected:
  void one_of(const Key& key, int& index, std::span<const std::string_view> names) override {
    line(key, fmt::format("\"{}\"", names[static_cast<std::size_t>(index)]),
         fmt::format("\"{}\"", fmt::join(names, "\", \"")));
  }
  void section(const Key& key, bool present, const std::function<void()>& contents) override {
    static const toml::table nothing;
    const toml::table* inner = table_->get_as<toml::table>(key.name);
    if (present) block(key, "[{}]", inner != nullptr ? *inner : nothing, true, contents);
  }
  void list(const Key& key, std::size_t size, const std::function<void(std::size_t)>& item) override {
    const toml::array* items = table_->get_as<toml::array>(key.name);
    for (std::size_t i = 0; items != nullptr && i < size; ++i)
      block(key, "[[{}]]", *items->get_as<toml::table>(i), i == 0, [&] { item(i); });
  }

 private:
  void line(const Key& key, const std::string& value, const std::string& allowed) {
    const bool given = table_->contains(key.name);
    if (!key.is_used || (!given && !explained_)) return;
    if (explained_) {
      std::string about(key.meaning);
      if (!key.unit.empty()) about += fmt::format(" [{}]", key.unit);
      if (!allowed.empty()) about += fmt::format(" Allowed: {}.", allowed);
      if (!key.fallback.empty() && !given) about += fmt::format(" Default: {}.", key.fallback);
      text_ += "\n" + comment(about);
    }
    text_ += fmt::format("{}{} = {}\n", given ? "" : "#", key.name, value);
  }

  void block(const Key& key, fmt::string_view header, const toml::table& inner, bool explained,
             const std::function<void()>& contents) {
    const toml::table* outer = std::exchange(table_, &inner);
    const bool outer_explained = std::exchange(explained_, explained);
    const std::string outer_path =
        std::exchange(path_, path_ + (path_.empty() ? "" : ".") + std::string(key.name));
    text_ += "\n";
    if (explained) text_ += "\n" + comment(std::string(key.meaning));
    text_ += fmt::format(fmt::runtime(header), path_) + "\n";
    contents();
    table_ = outer, explained_ = outer_explained, path_ = outer_path;
  }

  const toml::table* table_;
  bool explained_ = true;
  std::string path_, text_;
};

}  // namespace

std::string commented_case(std::string_view text) {
  Case scene = parse_case(text, "the case to start from");
  const toml::table given = toml::parse(text);
  Explainer explainer(given);
  declare(explainer, scene);
  return explainer.finished();
}

}  // namespace porosph
