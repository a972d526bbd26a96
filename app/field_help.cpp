#include "app/field_help.hpp"

#include "solver/analysis/derived_fields.hpp"
#include "solver/fields/field_table.hpp"

namespace porosph::app {

std::string field_help() {
  std::string stored, computed;
  for (const std::string& name : standard_field_names()) stored += (stored.empty() ? "" : ", ") + name;
  for (const char* name : {"PrincipalStress", "MeanStress", "VonMisesStress", "Strain"})
    computed += std::string(name) + ", ";
  for (const Field& field : derived_field_table()) computed += std::string(field.name) + ", ";
  computed.resize(computed.size() - 2);
  return "what to draw: of the series (" + stored + "), or computed from it (" + computed +
         "); a tensor needs a component (EffectiveStress:YY, PrincipalStress:S1), a vector without one shows "
         "its magnitude";
}

}  // namespace porosph::app
