// The particle data that can be asked for, by the names they have in the files.
#pragma once

#include <string>
#include <vector>

#include "solver/output/frame.hpp"
#include "solver/run/simulation.hpp"

namespace porosph {

/// The named fields of the present instant, of field_table() or of a law from outside; nothing else is
/// computed. Throws std::invalid_argument for an unknown name.
Frame make_frame(Simulation& simulation, const std::vector<std::string>& fields);

}  // namespace porosph
