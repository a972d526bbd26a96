#include "solver/fields/field_table.hpp"

#include <algorithm>

#include "solver/soil/laws.hpp"

namespace porosph {
namespace {

void add(std::vector<Field>& table, const Field& field) {
  if (std::ranges::find(table, field.name, &Field::name) == table.end()) table.push_back(field);
}

template <SoilLaw... Law>
void add_history(std::vector<Field>& table, LawList<Law...>) {
  const auto add_of = [&](const auto& history) {
    for (const Field& field : history) add(table, field);
  };
  (add_of(Law::history), ...);
}

std::vector<std::string> names(bool standard) {
  std::vector<std::string> found;
  for (const Field& field : field_table())
    if (field.standard == standard) found.emplace_back(field.name);
  return found;
}

}  // namespace

std::vector<std::string> component_names(FieldKind kind) {
  switch (kind) {
    case FieldKind::vector:
      return {"X", "Y", "Z"};
    case FieldKind::symmetric:
      return {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    case FieldKind::principal:
      return {"S1", "S2", "S3"};
    case FieldKind::scalar:
    case FieldKind::integer:
      break;
  }
  return {};
}

const std::vector<Field>& field_table() {
  using namespace particle_fields;
  static const std::vector<Field> table = [] {
    std::vector<Field> all = {displacement,
                              velocity,
                              effective_stress,
                              total_stress,
                              pore_pressure,
                              density,
                              mass,
                              smoothing_length,
                              soil_id,
                              particle_id,
                              principal_stress,
                              mean_stress,
                              deviatoric_stress,
                              von_mises_stress,
                              strain,
                              excess_stress,
                              yielding,
                              mobilised_friction,
                              head,
                              pressure_head,
                              saturation,
                              darcy_velocity,
                              hydraulic_gradient,
                              gradient_ratio,
                              pore_pressure_ratio};
    add_history(all, Laws{});
    return all;
  }();
  return table;
}

std::vector<std::string> standard_field_names() { return names(true); }
std::vector<std::string> optional_field_names() { return names(false); }

const Field* find_field(std::string_view name) {
  const auto& table = field_table();
  const auto found = std::ranges::find(table, name, &Field::name);
  return found == table.end() ? nullptr : &*found;
}

std::string field_unit(std::string_view name) {
  const Field* field = find_field(name);
  return field == nullptr || field->unit == "-" ? "" : std::string(field->unit);
}

}  // namespace porosph
