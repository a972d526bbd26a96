// One frame as one file of VTK's XML formats.
#pragma once

#include <filesystem>

#include "solver/output/frame.hpp"
#include "vtk_io/particle_series.hpp"

namespace porosph {

/// Appended raw data with UInt64 headers. Throws WriteError; std::invalid_argument as view_of.
void write_frame(const std::filesystem::path& file, const Frame& frame, const SeriesOptions& options);

}  // namespace porosph
