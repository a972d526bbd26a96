#include "vtk_io/run_folder/element_csv.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vtk_io/run_folder/csv.hpp"

namespace porosph {
namespace {

std::vector<std::string> remembered(const std::vector<ElementRun>& runs) {
  std::vector<std::string> names;
  for (const ElementRun& run : runs)
    for (const Field& field : run.path.history)
      if (std::ranges::find(names, field.name) == names.end()) names.emplace_back(field.name);
  return names;
}

std::string history_cell(const ElementPath& path, const ElementState& state, const std::string& name) {
  std::string cell;
  for (std::size_t k = 0; k < path.history.size(); ++k)
    if (path.history[k].name == name) append_csv_number(cell, state.history[k]);
  return cell;
}

std::string row(const ElementRun& run, std::size_t step, const std::vector<std::string>& history) {
  const ElementPath& path = run.path;
  const ElementState& s = path.states[step];
  std::string text = csv_line({run.soil, std::string(name_of(path.setup.test))});
  text.pop_back();
  text += fmt::format(",{:.17g},{:.17g},{}", path.setup.axial_stress, path.setup.radial_stress, step);
  for (const double value : {-s.strain.yy, -s.strain.xx, -s.strain.zz, 2 * s.strain.xy,
                             s.volume_compression(), -s.stress.yy, -s.stress.xx, -s.stress.zz, s.stress.xy,
                             s.mean_pressure(), path.deviator(s), s.pore_pressure, s.mobilised_friction()}) {
    text += ',';
    append_csv_number(text, value == 0 ? 0 : value);  // no -0
  }
  for (const std::string& name : history) text += "," + history_cell(path, s, name);
  return text + "\n";
}

}  // namespace

std::string label_of(const ElementRun& run, bool with_soil) {
  const double axial = run.path.setup.axial_stress / 1e3, radial = run.path.setup.radial_stress / 1e3;
  const std::string stress =
      axial == radial ? fmt::format("{:g} kPa", axial) : fmt::format("{:g} / {:g} kPa", axial, radial);
  return with_soil ? run.soil + ", " + stress : stress;
}

std::string element_csv(const std::vector<ElementRun>& runs) {
  const std::vector<std::string> history = remembered(runs);
  std::string text =
      "soil,test,axial_stress_at_start,radial_stress_at_start,step,strain_axial,strain_x,strain_z,gamma,"
      "strain_volume,stress_axial,stress_x,stress_z,tau,p,q,pore_pressure,mobilised_friction";
  for (const std::string& name : history) text += "," + name;
  text += "\n";
  for (const ElementRun& run : runs)
    for (std::size_t step = 0; step < run.path.states.size(); ++step) text += row(run, step, history);
  return text;
}

}  // namespace porosph
