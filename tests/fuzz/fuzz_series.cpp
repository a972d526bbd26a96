// Any bytes as a .pvd or as a frame: contents or a ReadError. Names in a .pvd stay in its folder.
#include <vtkObject.h>

#include <cstdlib>
#include <filesystem>

#include "tests/fuzz/memory_file.hpp"
#include "vtk_io/particle_data.hpp"
#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;

namespace {

bool leaves_folder(const std::string& name) {
  return !(std::filesystem::path("/folder") / name).lexically_normal().string().starts_with("/folder/");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vtkObject::GlobalWarningDisplayOff();
  const MemoryFile file(data, size);
  try {
    for (const SeriesFrame& frame : read_pvd(file.path()))
      if (leaves_folder(frame.file)) std::abort();
  } catch (const ReadError&) {
  }
  try {
    frame_of(*read_frame(file.path()));
  } catch (const ReadError&) {
  }
  return 0;
}
