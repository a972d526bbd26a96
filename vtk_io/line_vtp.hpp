// Lines for ParaView.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/case/case.hpp"

namespace porosph {

/// Writes lines through points [m] as a .vtp, each with one number under this name. Throws WriteError.
void write_lines_vtp(const std::filesystem::path& file, const std::vector<std::vector<Point>>& lines,
                     const std::string& name, const std::vector<double>& values);

}  // namespace porosph
