// The ParaView Python script beside a series, which opens it coloured.
#pragma once

#include <filesystem>
#include <string>

#include "solver/output/frame.hpp"

namespace porosph {

/// Python text, for ParaView 5.11 or later: shows `pvd` (a name) in the script's own folder, or else in
/// `folder`, coloured by the vertical effective stress or, where `frame` has none, its first field.
std::string paraview_script(const std::filesystem::path& folder, const std::string& pvd, const Frame& frame);

}  // namespace porosph
