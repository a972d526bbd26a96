// What there is to say of a field of the particles.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porosph {

/// What a field has per particle, and how its components are called in files.
enum class FieldKind {
  scalar,
  integer,
  vector,     ///< X, Y, Z
  symmetric,  ///< XX, YY, ZZ, XY, YZ, XZ: VTK's order
  principal   ///< S1, S2, S3, largest first
};

/// Names are CamelCase, as files have them; units are SI. Symbol and words are what charts and captions say.
struct Field {
  std::string_view name, unit, symbol, words;
  std::string_view meaning;  ///< for the documents
  FieldKind kind = FieldKind::scalar;
  bool standard = false;  ///< written where the case does not choose fields
};

/// Names of the components; empty for a scalar.
std::vector<std::string> component_names(FieldKind kind);

}  // namespace porosph
