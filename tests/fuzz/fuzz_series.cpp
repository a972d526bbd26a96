// Any bytes as a .pvd or as a frame: contents or a ReadError. Names in a .pvd stay in its folder.
#include <vtkObject.h>

#include <cstdlib>

#include "tests/fuzz/memory_file.hpp"
#include "vtk_io/particle_data.hpp"
#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vtkObject::GlobalWarningDisplayOff();
  const MemoryFile file(data, size);
  try {
    for (const SeriesFrame& frame : read_pvd(file.path()))
      if (frame.file.starts_with('/') || frame.file.find("../") != std::string::npos) std::abort();
  } catch (const ReadError&) {
  }
  try {
    frame_of(*read_frame(file.path()));
  } catch (const ReadError&) {
  }
  return 0;
}
