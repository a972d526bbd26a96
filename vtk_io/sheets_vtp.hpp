// Sheets as lines that ParaView opens: one .vtp for each frame.
#pragma once

#include <filesystem>
#include <vector>

#include "solver/output/frame.hpp"

namespace porosph {

/// Writes each as a line through its nodes where they are, with the point data Displacement [m], AxialForce
/// and ShearForce [N/m], BendingMoment [N] and SheetId, its place among them. Throws WriteError.
void write_sheets_vtp(const std::filesystem::path& file, const std::vector<SheetFrame>& sheets);

/// What was written so, but the names. Throws ReadError.
std::vector<SheetFrame> read_sheets_vtp(const std::filesystem::path& file);

}  // namespace porosph
