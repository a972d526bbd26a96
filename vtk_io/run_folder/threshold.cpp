#include "vtk_io/run_folder/threshold.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace porosph {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

}  // namespace

Threshold parse_threshold(const std::string& text) {
  const auto fail = [&] {
    throw std::runtime_error(fmt::format(
        "'{}': must be PATH>NUMBER (or >=, <, <=), such as errors.EffectiveStress_YY.relative_l2>0.02",
        text));
  };
  const auto at = text.find_first_of("<>");
  if (at == std::string::npos) fail();
  const bool or_equal = at + 1 < text.size() && text[at + 1] == '=';
  Threshold t{.text = text, .path = trimmed(text.substr(0, at)), .relation = Threshold::Relation::above};
  if (text[at] == '>') t.relation = or_equal ? Threshold::Relation::at_least : Threshold::Relation::above;
  if (text[at] == '<') t.relation = or_equal ? Threshold::Relation::at_most : Threshold::Relation::below;
  const std::string number = trimmed(text.substr(at + (or_equal ? 2 : 1)));
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), t.limit);
  if (t.path.empty() || error != std::errc() || stop != number.data() + number.size() ||
      !std::isfinite(t.limit))
    fail();
  return t;
}

ThresholdOutcome check(const Threshold& threshold, const nlohmann::ordered_json& summary) {
  const nlohmann::ordered_json* node = &summary;
  std::istringstream steps(threshold.path);
  for (std::string step; std::getline(steps, step, '.');) {
    if (node->is_object() && node->contains(step)) {
      node = &(*node)[step];
      continue;
    }
    std::vector<std::string> known;
    if (node->is_object())
      for (const auto& item : node->items()) known.push_back(item.key());
    throw std::runtime_error(
        fmt::format("'{}': the summary has no '{}'; here it has {}", threshold.text, step,
                    known.empty() ? "nothing (errors are there where the case names a reference)"
                                  : fmt::format("{}", fmt::join(known, ", "))));
  }
  if (!node->is_number() && !node->is_null())
    throw std::runtime_error(fmt::format("'{}': '{}' is not a number", threshold.text, threshold.path));
  const double value = node->is_null() ? std::numeric_limits<double>::quiet_NaN() : node->get<double>();
  switch (threshold.relation) {  // written so that not-a-number fails
    case Threshold::Relation::above:
      return {!(value <= threshold.limit), value};
    case Threshold::Relation::at_least:
      return {!(value < threshold.limit), value};
    case Threshold::Relation::below:
      return {!(value >= threshold.limit), value};
    case Threshold::Relation::at_most:
      return {!(value > threshold.limit), value};
  }
  throw std::logic_error("unknown relation");
}

}  // namespace porosph
