// The particle data that can be asked for, by the names they have in the files.
#pragma once

#include <string>
#include <vector>

#include "solver/output/frame.hpp"
#include "solver/simulation/simulation.hpp"

namespace porosph {

struct FieldDescription {
  std::string name, unit, meaning;
  std::vector<std::string> components;  ///< empty for a scalar
};

/// All fields, in the order of the documents.
const std::vector<FieldDescription>& known_fields();

/// The named fields of the present instant; nothing else is computed. Throws std::invalid_argument for an
/// unknown name.
Frame make_frame(Simulation& simulation, const std::vector<std::string>& fields);

}  // namespace porosph
