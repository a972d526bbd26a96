#include <utility>

#include "solver/case/case_file.hpp"
#include "solver/case/fields.hpp"
#include "solver/case/toml_text.hpp"

namespace porosph {
namespace {

/// Writes declared values that are used, each with its unit or meaning beside it.
class Writer : public Fields {
 public:
  std::string result;

  void number(const Key& key, double& value, const Range& range) override {
    if (range.contains(value) && value < never)
      line(key, toml_text(value));
    else
      unset(key);
  }
  void number_or(const Key& key, double& value, const Range& range, std::string_view word,
                 bool& is_word) override {
    if (is_word)
      line(key, fmt::format("\"{}\"", word));
    else
      number(key, value, range);
  }
  void numbers(const Key& key, std::vector<double>& values, const Range&) override {
    line(key, toml_text(values));
  }
  void integer(const Key& key, int& value, const Range&) override { line(key, fmt::to_string(value)); }
  void flag(const Key& key, bool& value) override { line(key, value ? "true" : "false"); }
  void flag_or(const Key& key, bool& value, std::string_view word, bool& is_word) override {
    line(key, is_word ? fmt::format("\"{}\"", word) : value ? "true" : "false");
  }
  void text(const Key& key, std::string& value) override { line(key, toml_text(value)); }
  void name(const Key& key, std::string& value) override {
    if (!value.empty()) line(key, toml_text(value));  // one that may be left out
  }
  void words(const Key& key, std::vector<std::string>& values, std::span<const std::string>) override {
    line(key, toml_text(values));
  }
  void texts(const Key& key, std::vector<std::string>& values) override { line(key, toml_text(values)); }
  void point(const Key& key, Point& value) override {
    if (value.allFinite())
      line(key, toml_text(value));
    else
      unset(key);
  }
  void pairs(const Key& key, std::vector<Point>& values) override {
    if (!values.empty()) line(key, toml_text(values));
  }
  void polygon(const Key& key, Polygon& value) override { line(key, toml_text(value)); }
  void polygons(const Key& key, std::vector<Polygon>& values) override { line(key, toml_text(values)); }

 protected:
  void one_of(const Key& key, int& index, std::span<const std::string_view> names) override {
    line(key, fmt::format("\"{}\"", names[static_cast<std::size_t>(index)]));
  }
  void section(const Key& key, bool present, const std::function<void()>& contents) override {
    if (present) block(key, "[{}]", contents);
  }
  void list(const Key& key, std::size_t size, const std::function<void(std::size_t)>& item) override {
    for (std::size_t i = 0; i < size; ++i) block(key, "[[{}]]", [&] { item(i); });
  }

 private:
  void unset(const Key& key) {
    if (key.is_used && key.fallback != "none")
      result += fmt::format("# {} is not set: {}\n", key.name, key.fallback);
  }
  void line(const Key& key, const std::string& value) {
    if (!key.is_used) return;
    result += fmt::format("{} = {}", key.name, value);
    result += key.unit.empty() ? "\n" : fmt::format("  # {}\n", key.unit);
  }
  void block(const Key& key, fmt::string_view header, const std::function<void()>& contents) {
    const std::string outer =
        std::exchange(path_, path_ + (path_.empty() ? "" : ".") + std::string(key.name));
    result += fmt::format("\n{}\n", fmt::format(fmt::runtime(header), path_));
    contents();
    path_ = outer;
  }
  std::string path_;
};

}  // namespace

std::string write_case(const Case& scene) {
  Writer writer;
  Case copy = scene;  // declarations are the same for readers, which change what is declared
  declare(writer, copy);
  return writer.result;
}

}  // namespace porosph
