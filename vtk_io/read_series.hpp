// Reading back what SeriesWriter wrote.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

#include "vtk_io/pvd.hpp"

namespace porosph {

struct Series {
  std::filesystem::path folder;     ///< of the .pvd
  std::vector<SeriesFrame> frames;  ///< at least one, in order of time
  std::filesystem::path file(std::size_t frame) const { return folder / frames.at(frame).file; }
};

/// The times and files that a .pvd names, which must lie in its folder. Throws ReadError.
Series open_series(const std::filesystem::path& pvd);

/// The particles of a .vtp or .vtu with its data appended raw, as SeriesWriter and ParaView write them:
/// points, point data and field data, and one vertex cell per particle whatever the cells of the file. Throws
/// ReadError naming the file if it is cut short, damaged or something else.
vtkSmartPointer<vtkPolyData> read_frame(const std::filesystem::path& file);

}  // namespace porosph
