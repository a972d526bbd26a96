#include "solver/case/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/math/constants/constants.hpp>
#include <charconv>
#include <cmath>
#include <optional>

namespace porosph {
namespace {

/// A unit: factor * 10^power of the SI unit with these exponents of metre, kilogram, second and radian.
struct Unit {
  std::array<int, 4> dimension{};
  int power = 0;
  double factor = 1;
};
struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr std::array<int, 4> none{}, length{1, 0, 0, 0}, mass{0, 1, 0, 0}, duration{0, 0, 1, 0},
    angle{0, 0, 0, 1}, frequency{0, 0, -1, 0}, force{1, 1, -2, 0}, pressure{-1, 1, -2, 0},
    weight{-2, 1, -2, 0};
constexpr double degree = boost::math::constants::degree<double>();
// Foot and pound as they are defined: 0.3048 m, 4.4482216152605 N.
constexpr double pound = 44482216152605e-13, inch = 0.0254, foot = 0.3048;

constexpr auto known = std::to_array<NamedUnit>({
    {"m", {length}},
    {"km", {length, 3}},
    {"dm", {length, -1}},
    {"cm", {length, -2}},
    {"mm", {length, -3}},
    {"um", {length, -6}},
    {"ft", {length, -4, 3048}},
    {"in", {length, -4, 254}},
    {"kg", {mass}},
    {"g", {mass, -3}},
    {"t", {mass, 3}},
    {"s", {duration}},
    {"ms", {duration, -3}},
    {"min", {duration, 0, 60}},
    {"h", {duration, 0, 3600}},
    {"d", {duration, 0, 86400}},
    {"yr", {duration, 0, 31557600}},  // 365.25 d
    {"Hz", {frequency}},
    {"kHz", {frequency, 3}},
    {"N", {force}},
    {"kN", {force, 3}},
    {"MN", {force, 6}},
    {"GN", {force, 9}},
    {"lbf", {force, 0, pound}},
    {"Pa", {pressure}},
    {"hPa", {pressure, 2}},
    {"kPa", {pressure, 3}},
    {"MPa", {pressure, 6}},
    {"GPa", {pressure, 9}},
    {"bar", {pressure, 5}},
    {"psi", {pressure, 0, pound / (inch * inch)}},
    {"psf", {pressure, 0, pound / (foot * foot)}},
    {"ksf", {pressure, 3, pound / (foot * foot)}},
    {"pcf", {weight, 0, pound / (foot * foot * foot)}},
    {"rad", {angle}},
    {"deg", {angle, 0, degree}},
    {"degree", {angle, 0, degree}},
    {"degrees", {angle, 0, degree}},
    {"1", {none}},
    {"%", {none, -2}},
});

// Those that messages and documents offer, by the dimension of the key.
constexpr auto usual = std::to_array<std::string_view>(
    {"m",    "km",   "cm",   "mm",    "ft",      "in",    "s",     "ms",    "min",   "h",
     "d",    "yr",   "Pa",   "kPa",   "MPa",     "GPa",   "bar",   "kN/m2", "psi",   "psf",
     "N/m",  "kN/m", "N/m3", "kN/m3", "Pa/m",    "kPa/m", "pcf",   "m/s",   "cm/s",  "m/h",
     "m/d",  "mm/h", "m/s2", "ft/s2", "degrees", "deg",   "rad",   "rad/s", "deg/s", "1/m",
     "1/cm", "1/ft", "%",    "N*m",   "kN*m",    "MN*m",  "kg/m2", "t/m2",  "Hz"});

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// One factor of a unit: "kN", "m3", "s^-1".
std::optional<Unit> read_factor(std::string_view text) {
  const auto end_of_name = [&] {
    std::size_t at = text.size();
    while (at > 1 && is_digit(text[at - 1])) --at;
    if (at > 1 && text[at - 1] == '-') --at;
    return at;
  };
  const std::size_t end = end_of_name();
  std::string_view name = text.substr(0, end);
  if (end < text.size() && name.size() > 1 && name.back() == '^') name.remove_suffix(1);
  int exponent = 1;
  if (end < text.size()) {
    const auto [rest, error] = std::from_chars(text.data() + end, text.data() + text.size(), exponent);
    if (error != std::errc{} || rest != text.data() + text.size() || std::abs(exponent) > 9)
      return std::nullopt;
  }
  const auto* found = std::find_if(known.begin(), known.end(), [&](const auto& u) { return u.name == name; });
  if (found == known.end()) return std::nullopt;
  Unit unit = found->unit;
  for (int& d : unit.dimension) d *= exponent;
  unit.power *= exponent;
  unit.factor = std::pow(unit.factor, exponent);
  return unit;
}

/// Factors joined by '*' or '/', each '/' for the one factor behind it.
std::optional<Unit> read_unit(std::string text) {
  for (const auto& [sign, plain] : {std::pair{"²", "2"}, {"³", "3"}, {"·", "*"}, {"°", "deg"}, {"µ", "u"}})
    boost::replace_all(text, sign, plain);
  Unit whole;
  int sign = 1;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("*/", begin), text.size());
    const auto factor = read_factor(std::string_view(text).substr(begin, end - begin));
    if (!factor) return std::nullopt;
    for (std::size_t i = 0; i < whole.dimension.size(); ++i)
      whole.dimension[i] += sign * factor->dimension[i];
    whole.power += sign * factor->power;
    whole.factor = sign > 0 ? whole.factor * factor->factor : whole.factor / factor->factor;
    sign = end < text.size() && text[end] == '/' ? -1 : 1;
    begin = end + 1;
  }
  return whole;
}

Unit unit_of_key(std::string_view unit) {
  if (unit.empty() || unit == "-") return {};
  const auto known_unit = read_unit(std::string(unit));
  if (!known_unit) throw std::logic_error(fmt::format("a key has the unit '{}', which is not known", unit));
  return *known_unit;
}

std::size_t end_of_number(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t begin = at;
    while (at < text.size() && (is_digit(text[at]) || (text[at] == '.' && at + 1 < text.size()))) ++at;
    return at > begin;
  };
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
  if (!digits()) return 0;
  const std::size_t mantissa = at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
    if (!digits()) return mantissa;
  }
  return at;
}

/// The digits of `number` times 10^power, rounded once.
std::optional<double> read_number(std::string_view number, int power) {
  if (number.starts_with('+')) number.remove_prefix(1);
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  int exponent = 0;
  if (e < number.size()) {
    std::string_view digits = number.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error != std::errc{} || rest != digits.data() + digits.size() || std::abs(exponent) > 999)
      return std::nullopt;
  }
  const std::string shifted = fmt::format("{}e{}", number.substr(0, e), exponent + power);
  double value = 0;
  const auto [rest, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (error != std::errc{} || rest != shifted.data() + shifted.size()) return std::nullopt;
  return value;
}

}  // namespace

bool begins_as_number(std::string_view text) { return end_of_number(text) > 0; }

std::string usual_units(std::string_view unit) {
  const Unit wanted = unit_of_key(unit);
  std::string list;
  for (const std::string_view name : usual)
    if (read_unit(std::string(name))->dimension == wanted.dimension)
      list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

std::string_view unit_of_component(std::string_view unit, int i) {
  const std::size_t comma = unit.find(", ");
  if (comma == std::string_view::npos) return unit;
  return i == 0 ? unit.substr(0, comma) : unit.substr(comma + 2);
}

Measure read_measure(std::string_view text, std::string_view unit) {
  const Unit wanted = unit_of_key(unit);
  const std::size_t end = end_of_number(text);
  const std::string name = boost::trim_copy(std::string(text.substr(end)));
  const std::string offer = "; allowed are " + usual_units(unit);
  if (end == 0 || name.empty())
    return {0, fmt::format("must be a number{}{}, or text of a number and a unit{}",
                           unit.empty() ? "" : " in ", unit, offer)};
  const auto given = read_unit(name);
  if (!given) return {0, fmt::format("has the unit '{}', which is not known{}", name, offer)};
  if (given->dimension != wanted.dimension)
    return {0, fmt::format("has the unit '{}', which does not convert to {}{}", name,
                           unit.empty() || unit == "-" ? "a pure number" : unit, offer)};
  const auto digits = read_number(text.substr(0, end), given->power - wanted.power);
  if (!digits) return {0, fmt::format("must begin with a number, and '{}' is none", text.substr(0, end))};
  return {*digits * (given->factor / wanted.factor), ""};
}

}  // namespace porosph
