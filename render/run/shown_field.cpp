#include "render/run/shown_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>

#include "solver/analysis/derived_fields.hpp"

namespace porosph::render {
namespace {

/// Unit in the files: of the tables, or by the usual names.
std::string unit_of(const std::string& field) {
  if (const Field* known = find_shown_field(field)) return std::string(known->unit);
  return field.ends_with("Stress") ? "Pa" : "-";
}

/// As the tables have it, "p_w", with subscripts as Canvas draws them, "p_{w}"; empty for an unknown field.
std::string symbol_of(const std::string& field) {
  const Field* known = find_shown_field(field);
  std::string symbol(known == nullptr ? "" : known->symbol);
  if (const auto mark = symbol.find('_'); mark != std::string::npos)
    symbol = symbol.substr(0, mark) + "_{" + symbol.substr(mark + 1) + "}";
  return symbol;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// What stands before and after the direction.
const std::map<std::string, std::pair<std::string, std::string>>& known_words() {
  static const std::map<std::string, std::pair<std::string, std::string>> words = {
      {"EffectiveStress", {"Effective ", "stress"}},
      {"TotalStress", {"Total ", "stress"}},
      {"Displacement", {"", "displacement"}},
      {"Velocity", {"", "velocity"}},
      {"PorePressure", {"", "pore pressure"}},
      {"Density", {"", "density"}},
      {"DeviatoricStress", {"Deviatoric ", "stress"}},
      {"ExcessStress", {"Excess over theory, ", "effective stress"}},
      {"Strain", {"", "strain"}},
      {"MeanStress", {"Mean effective ", "stress"}},
      {"SoilId", {"", "soils"}},
      {"Mass", {"", "mass of the particles"}},
      {"SmoothingLength", {"", "smoothing length"}},
      {"ParticleId", {"", "numbers of the particles"}},
      {"VonMisesStress", {"von Mises ", "stress"}}};
  return words;
}

}  // namespace

std::string file_name(const std::string& text) {
  std::string out = text;
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return out;
}

ShownUnit shown_unit(const std::string& field, double largest) {
  if (field == "Displacement") return largest < 0.2 ? ShownUnit{"mm", 1e3} : ShownUnit{"m", 1};
  if (field.ends_with("Strain")) return {"%", 100};
  static const std::map<std::string, ShownUnit> units = {{"Pa", {"kPa", 1e-3}},
                                                         {"-", {"", 1}},
                                                         {"kg/m3", {"kg/m³", 1}},
                                                         {"deg", {"°", 1}},
                                                         {"degrees", {"°", 1}}};
  const std::string unit = unit_of(field);
  const auto found = units.find(unit);
  return found == units.end() ? ShownUnit{unit, 1} : found->second;
}

std::string shown_label(const FieldSelection& selection, const ShownUnit& unit) {
  static const std::map<std::string, std::string> principal = {
      {"S1", "σ'_{1}"}, {"S2", "σ'_{2}"}, {"S3", "σ'_{3}"}};
  if (const auto p = principal.find(selection.component);
      p != principal.end() && selection.name == "PrincipalStress")
    return fmt::format("{} [{}]", p->second, unit.name);
  const std::string symbol = symbol_of(selection.name);
  std::string label = symbol.empty() ? selection.name : symbol;
  if (!selection.component.empty())
    label += symbol.empty() ? " " + selection.component : "_{" + lower(selection.component) + "}";
  if (selection.component.empty() && (selection.name == "Displacement" || selection.name == "Velocity"))
    label = "|" + label + "|";
  return unit.name.empty() ? label : label + " [" + unit.name + "]";
}

std::string shown_name(const FieldSelection& selection) {
  static const std::map<std::string, std::string> directions = {{"XX", "horizontal "},   {"YY", "vertical "},
                                                                {"ZZ", "out-of-plane "}, {"XY", "shear "},
                                                                {"X", "horizontal "},    {"Y", "vertical "}};
  const auto& words = known_words();
  if (const Field* field = find_shown_field(selection.name);
      selection.component.empty() && !words.contains(selection.name) && field != nullptr) {
    std::string text(field->words);
    if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
  }
  static const std::map<std::string, std::string> principal = {{"S1", "Largest principal effective stress"},
                                                               {"S2", "Middle principal effective stress"},
                                                               {"S3", "Smallest principal effective stress"}};
  if (const auto p = principal.find(selection.component);
      p != principal.end() && selection.name == "PrincipalStress")
    return p->second;
  const auto word = words.find(selection.name);
  const auto direction = directions.find(selection.component);
  if (word == words.end() || (direction == directions.end() && !selection.component.empty()))
    return selection.component.empty() ? selection.name : selection.name + " " + selection.component;
  std::string text =
      word->second.first + (selection.component.empty() ? "" : direction->second) + word->second.second;
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string name_in_sentence(const FieldSelection& selection) {
  const std::string name = shown_name(selection);
  const bool has_words = !name.starts_with(selection.name) || known_words().contains(selection.name) ||
                         find_shown_field(selection.name) != nullptr;
  return has_words ? lower(name.substr(0, 1)) + name.substr(1) : name;
}

ColourMap usual_map(const FieldSelection& selection) {
  const std::string& c = selection.component;
  if (selection.name == "ExcessStress") return ColourMap::cool_warm;
  return c == "XY" || c == "YZ" || c == "XZ" || c == "X" || c == "Z" ? ColourMap::cool_warm
                                                                     : ColourMap::viridis;
}

bool usually_logarithmic(const FieldSelection& selection) { return selection.name == "PlasticStrain"; }

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

}  // namespace porosph::render
