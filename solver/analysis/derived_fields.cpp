#include "solver/analysis/derived_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "solver/analysis/frame_values.hpp"
#include "solver/fields/field_table.hpp"
#include "solver/output/invariants.hpp"
#include "solver/output/strain.hpp"

namespace porosph {
namespace {

using Names = std::vector<std::string>;
using Doubles = std::vector<double>;

const std::string water_unit_weight = "WaterUnitWeight";
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

namespace derived {

constexpr Field mean_pressure{"MeanPressure", "Pa", "p'", "mean effective pressure",
                              "p' = -tr(sigma') / 3, positive in compression"};
constexpr Field maximum_shear_stress{"MaximumShearStress", "Pa", "τ_max", "maximum shear stress",
                                     "(sigma'_1 - sigma'_3) / 2"};
constexpr Field stress_ratio{"StressRatio", "-", "q / p'", "stress ratio", "q / p'; not a number in tension"};
constexpr Field stress_obliquity{"StressObliquity", "deg", "θ_max", "largest obliquity of stress",
                                 "asin((sigma'_1 - sigma'_3) / -(sigma'_1 + sigma'_3)); not a number in "
                                 "tension"};
constexpr Field volumetric_strain{"VolumetricStrain", "-", "ε_v", "volumetric strain",
                                  "change of volume since t = 0, positive in expansion"};
constexpr Field shear_strain{"ShearStrain", "-", "γ_max", "maximum shear strain",
                             "difference of the principal strains in the plane"};
constexpr Field pore_pressure_ratio{"PorePressureRatio", "-", "r_u", "pore pressure ratio",
                                    "r_u = p_w / sigma_yy, of total stress"};
constexpr Field head{"Head", "m", "h", "hydraulic head",
                     "y - p_w / gamma_w in wet soil, of a case with water"};

}  // namespace derived

/// The stored field, or the one computed from others.
FrameField field_of(const Frame& frame, const std::string& name) {
  const auto stored = std::ranges::find(frame.fields, name, &FrameField::name);
  return stored != frame.fields.end() ? *stored : *derived_field(frame, name);
}

template <class Tensor>
std::vector<Tensor> tensors_of(const Frame& frame, const std::string& name) {
  const FrameField field = field_of(frame, name);
  const auto& values = std::get<Doubles>(field.values);
  std::vector<Tensor> out(values.size() / 6);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {values[6 * i], values[6 * i + 1], values[6 * i + 2], values[6 * i + 3]};
  return out;
}

template <class Value>
Doubles of_stress(const Frame& frame, Value value) {
  const auto stress = tensors_of<Stress>(frame, "EffectiveStress");
  Doubles out;
  out.reserve(stress.size());
  for (const Stress& s : stress) out.push_back(value(s));
  return out;
}

template <class Tensor>
void append(Doubles& out, const Tensor& t) {
  out.insert(out.end(), {t.xx, t.yy, t.zz, t.xy, 0.0, 0.0});
}

Doubles total_stress_of(const Frame& frame) {
  const auto effective = tensors_of<Stress>(frame, "EffectiveStress");
  const Doubles pressure = values_of(frame, {"PorePressure", ""});
  Doubles out;
  out.reserve(6 * effective.size());
  for (std::size_t i = 0; i < effective.size(); ++i)
    append(out, effective[i].plus_isotropic(pressure[i]));  // eq. (12)
  return out;
}

Doubles principal(const Frame& frame) {
  Doubles out;
  for (const Stress& s : tensors_of<Stress>(frame, "EffectiveStress")) {
    const auto values = principal_stresses(s);
    out.insert(out.end(), values.begin(), values.end());
  }
  return out;
}

Doubles deviators(const Frame& frame) {
  Doubles out;
  for (const Stress& s : tensors_of<Stress>(frame, "EffectiveStress")) append(out, deviator(s));
  return out;
}

double stress_ratio_of(const Stress& s) {
  const double pressure = -s.mean();
  return pressure > 0 ? von_mises_stress(s) / pressure : no_number;
}

double stress_obliquity_of(const Stress& s) {
  const auto principal = principal_stresses(s);
  const double difference = principal[0] - principal[2], sum = -(principal[0] + principal[2]);
  return sum > 0 && difference <= sum ? std::asin(difference / sum) * 180 / M_PI : no_number;
}

Doubles strain_of(const Frame& frame) {
  const std::vector<Point> starts = starts_of(frame);
  std::vector<Point> positions(starts.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] = {frame.points[3 * i], frame.points[3 * i + 1]};
  Doubles out;
  const Doubles lengths = values_of(frame, {"SmoothingLength", ""});
  if (lengths.empty()) return out;
  for (const Strain& e : strain_between(starts, positions, volumes_of(frame), lengths.front()))
    append(out, e);
  return out;
}

/// det(I + 2 E) is the square of the volume's ratio.
double volumetric_strain_of(const Strain& e) {
  const double square = ((1 + 2 * e.xx) * (1 + 2 * e.yy) - 4 * e.xy * e.xy) * (1 + 2 * e.zz);
  return std::sqrt(square) - 1;
}

double shear_strain_of(const Strain& e) { return 2 * std::hypot(0.5 * (e.xx - e.yy), e.xy); }

template <class Value>
Doubles of_strain(const Frame& frame, Value value) {
  Doubles out;
  for (const Strain& e : tensors_of<Strain>(frame, "Strain")) out.push_back(value(e));
  return out;
}

Doubles pore_pressure_ratio_of(const Frame& frame) {
  Doubles out = values_of(frame, {"PorePressure", ""});
  const auto total = tensors_of<Stress>(frame, "TotalStress");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = total[i].yy < 0 ? out[i] / total[i].yy : 0;
  return out;
}

/// Where the soil is wet.
Doubles head_of(const Frame& frame) {
  Doubles out = values_of(frame, {"PorePressure", ""});
  const Doubles unit_weight = values_of(frame, {water_unit_weight, ""});
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = out[i] < 0 ? frame.points[3 * i + 1] - out[i] / unit_weight[i] : no_number;
  return out;
}

/// A field and how it is computed: from all fields of one of the lists, of which it takes the first that the
/// frame has.
struct Derivation {
  std::string_view field;
  std::vector<Names> sources;
  std::function<Doubles(const Frame&)> values;
};

const std::vector<Derivation>& derivations() {
  namespace stored = particle_fields;
  static const Names deformation = {"Displacement", "SmoothingLength", "Mass", "Density"};
  static const std::vector<Derivation> all = {
      {stored::total_stress.name, {{"EffectiveStress", "PorePressure"}}, total_stress_of},
      {stored::principal_stress.name, {{"EffectiveStress"}}, principal},
      {stored::mean_stress.name,
       {{"EffectiveStress"}},
       [](const Frame& f) { return of_stress(f, [](const Stress& s) { return s.mean(); }); }},
      {stored::deviatoric_stress.name, {{"EffectiveStress"}}, deviators},
      {stored::von_mises_stress.name,
       {{"EffectiveStress"}},
       [](const Frame& f) { return of_stress(f, von_mises_stress); }},
      {stored::strain.name, {deformation}, strain_of},
      {derived::mean_pressure.name,
       {{"EffectiveStress"}},
       [](const Frame& f) { return of_stress(f, [](const Stress& s) { return -s.mean(); }); }},
      {derived::maximum_shear_stress.name,
       {{"EffectiveStress"}},
       [](const Frame& f) {
         return of_stress(f, [](const Stress& s) {
           const auto principal = principal_stresses(s);
           return 0.5 * (principal[0] - principal[2]);
         });
       }},
      {derived::stress_ratio.name,
       {{"EffectiveStress"}},
       [](const Frame& f) { return of_stress(f, stress_ratio_of); }},
      {derived::stress_obliquity.name,
       {{"EffectiveStress"}},
       [](const Frame& f) { return of_stress(f, stress_obliquity_of); }},
      {derived::volumetric_strain.name,
       {{"Strain"}, deformation},
       [](const Frame& f) { return of_strain(f, volumetric_strain_of); }},
      {derived::shear_strain.name,
       {{"Strain"}, deformation},
       [](const Frame& f) { return of_strain(f, shear_strain_of); }},
      {derived::pore_pressure_ratio.name,
       {{"TotalStress", "PorePressure"}, {"EffectiveStress", "PorePressure"}},
       pore_pressure_ratio_of},
      {derived::head.name, {{"PorePressure", water_unit_weight}}, head_of},
  };
  return all;
}

const Derivation* find_derivation(const std::string& name) {
  const auto found = std::ranges::find(derivations(), name, &Derivation::field);
  return found == derivations().end() ? nullptr : &*found;
}

bool has_sources(const Frame& frame, const Derivation& d) {
  return std::ranges::any_of(d.sources, [&](const Names& names) {
    return std::ranges::all_of(names, [&](const std::string& name) { return has_field(frame, name); });
  });
}

}  // namespace

const std::vector<Field>& derived_field_table() {
  static const std::vector<Field> table = [] {
    std::vector<Field> all = {derived::mean_pressure,       derived::maximum_shear_stress,
                              derived::stress_ratio,        derived::stress_obliquity,
                              derived::volumetric_strain,   derived::shear_strain,
                              derived::pore_pressure_ratio, derived::head};
    std::erase_if(all, [](const Field& f) { return find_field(f.name) != nullptr; });
    return all;
  }();
  return table;
}

const Field* find_shown_field(const std::string& name) {
  if (const Field* field = find_field(name)) return field;
  const auto found = std::ranges::find(derived_field_table(), name, &Field::name);
  return found == derived_field_table().end() ? nullptr : &*found;
}

std::optional<FrameField> derived_field(const Frame& frame, const std::string& name) {
  const Derivation* d = find_derivation(name);
  if (d == nullptr || !has_sources(frame, *d)) return std::nullopt;
  return FrameField{name, component_names(find_shown_field(name)->kind), d->values(frame)};
}

std::vector<std::string> derivable_fields(const Frame& frame) {
  Names names;
  for (const Derivation& d : derivations())
    if (!has_field(frame, std::string(d.field)) && has_sources(frame, d)) names.emplace_back(d.field);
  return names;
}

std::string sources_of_field(const std::string& name) {
  const Derivation* d = find_derivation(name);
  return d == nullptr ? "" : fmt::format("{}", fmt::join(d->sources.back(), ", "));
}

void add_water_unit_weight(Frame& frame, double unit_weight) {
  if (!has_field(frame, water_unit_weight))
    frame.fields.push_back({water_unit_weight, {}, Doubles(frame.points.size() / 3, unit_weight)});
}

}  // namespace porosph
