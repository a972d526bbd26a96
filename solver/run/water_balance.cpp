#include "solver/run/water_balance.hpp"

namespace porosph {
namespace {

/// Names of faces, then of drains, in the order of Richards::through_faces().
std::vector<std::string> face_names(const WaterCase& water) {
  std::vector<std::string> names;
  for (const HydraulicFaceCase& face : water.faces) names.push_back(face.name);
  for (const DrainCase& drain : water.drains) names.push_back(drain.name);
  return names;
}

}  // namespace

std::vector<std::string> water_balance_columns(const Simulation& s) {
  std::vector<std::string> columns = {"water.entered", "water.left", "water.gained"};
  for (const std::string& name : face_names(s.scene().water))
    if (!name.empty()) columns.push_back(name + ".inflow");
  for (const FlowSectionCase& section : s.scene().sections) columns.push_back(section.name + ".discharge");
  return columns;
}

std::vector<double> water_balance_row(const Simulation& s) {
  const Richards::Balance balance = s.seepage()->richards().balance();
  std::vector<double> row = {balance.entered, balance.left, balance.gained};
  const std::vector<std::string> names = face_names(s.scene().water);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!names[i].empty()) row.push_back(s.seepage()->richards().through_faces()[i]);
  for (const double q : s.seepage()->through_sections()) row.push_back(q);
  return row;
}

}  // namespace porosph
