#include "solver/case/case_keys.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "solver/case/fields.hpp"

namespace porosph {
namespace {

class Collector : public Fields {
 public:
  std::vector<CaseKey> keys;

  void number(const Key& key, double&, const Range&) override { add(key); }
  void number_or(const Key& key, double&, const Range&, std::string_view word, bool&) override {
    add(key, {std::string(word)});
  }
  void numbers(const Key& key, std::vector<double>&, const Range&) override { add(key); }
  void integer(const Key& key, int&, const Range&) override { add(key); }
  void flag(const Key& key, bool&) override { add(key, {"true", "false"}); }
  void flag_or(const Key& key, bool&, std::string_view word, bool&) override {
    add(key, {std::string(word), "true", "false"});
  }
  void text(const Key& key, std::string&) override { add(key); }
  void name(const Key& key, std::string&) override { add(key); }
  void words(const Key& key, std::vector<std::string>&, std::span<const std::string>) override { add(key); }
  void texts(const Key& key, std::vector<std::string>&) override { add(key); }
  void point(const Key& key, Point&) override { add(key); }
  void pairs(const Key& key, std::vector<Point>&) override { add(key); }
  void polygon(const Key& key, Polygon&) override { add(key); }
  void polygons(const Key& key, std::vector<Polygon>&) override { add(key); }

 protected:
  void one_of(const Key& key, int&, std::span<const std::string_view> names) override {
    add(key, {names.begin(), names.end()});
  }
  void section(const Key& key, bool, const std::function<void()>& contents) override {
    within(std::string(key.name) + ".", contents);
  }
  void list(const Key& key, std::size_t, const std::function<void(std::size_t)>& item) override {
    within(std::string(key.name) + ".0.", [&] { item(0); });
  }

 private:
  void add(const Key& key, std::vector<std::string> values = {}) {
    keys.push_back({path_ + std::string(key.name), std::string(key.unit), std::move(values)});
  }
  void within(const std::string& inner, const std::function<void()>& contents) {
    const std::string outer = std::exchange(path_, path_ + inner);
    contents();
    path_ = outer;
  }
  std::string path_;
};

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream text(path);
  for (std::string part; std::getline(text, part, '.');) parts.push_back(part);
  return parts;
}

}  // namespace

std::vector<CaseKey> case_keys() {
  Collector collector;
  Case defaults;
  declare(collector, defaults);
  return collector.keys;
}

std::string unit_of_key(const std::string& path) {
  const std::vector<std::string> parts = parts_of(path);
  const auto same = [](const std::string& declared, const std::string& given) {
    return declared == "0" || declared == given;
  };
  for (const CaseKey& key : case_keys())
    if (std::ranges::equal(parts_of(key.path), parts, same) && !key.unit.empty()) return key.unit;
  return "-";
}

}  // namespace porosph
