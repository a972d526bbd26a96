// A regular grid for ParaView and other programs: VTK's ImageData.
#pragma once

#include <filesystem>

#include "solver/analysis/grid_values.hpp"

namespace porosph {

/// All fields of the grid as point data, not a number outside of the soil, with an array InSoil of 1 and 0.
/// Throws WriteError.
void write_grid_vti(const std::filesystem::path& file, const GridValues& grid);

}  // namespace porosph
