#include "vtk_io/frame_file.hpp"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fstream>
#include <string_view>

#include "vtk_io/particle_data.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {
namespace fs = std::filesystem;

namespace {

vtkSmartPointer<vtkUnstructuredGrid> grid_of(vtkPolyData& data) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(data.GetPoints());
  grid->SetCells(VTK_VERTEX, data.GetVerts());
  grid->GetPointData()->ShallowCopy(data.GetPointData());
  grid->GetFieldData()->ShallowCopy(data.GetFieldData());
  return grid;
}

vtkSmartPointer<vtkXMLWriter> writer_of(vtkPolyData& data, FrameFormat format) {
  vtkSmartPointer<vtkXMLWriter> writer;
  if (format == FrameFormat::poly_data) {
    writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
    writer->SetInputDataObject(&data);
  } else {
    writer = vtkSmartPointer<vtkXMLUnstructuredGridWriter>::New();
    writer->SetInputDataObject(grid_of(data));
  }
  return writer;
}

void set_compressor(vtkXMLWriter& writer, Compression compression) {
  switch (compression) {
    case Compression::none:
      return writer.SetCompressorTypeToNone();
    case Compression::lz4:
      return writer.SetCompressorTypeToLZ4();
    case Compression::zlib:
      return writer.SetCompressorTypeToZLib();
  }
}

/// VTK does not see an error in the last bytes, which reach the system when it closes the file.
bool is_complete(const fs::path& file) {
  constexpr std::string_view end = "</VTKFile>\n";
  std::ifstream stream(file, std::ios::binary);
  std::string tail(end.size(), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return stream.read(tail.data(), static_cast<std::streamsize>(tail.size())) && tail == end;
}

void add_text(vtkPolyData& data, const char* name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(text);
  data.GetFieldData()->AddArray(array);
}

}  // namespace

void write_frame(const fs::path& file, const Frame& frame, const SeriesOptions& options) {
  const auto data = view_of(frame, options.precision);
  add_text(*data, "Program", "Porosph " POROSPH_VERSION);
  if (!options.scene.title.empty()) add_text(*data, "Title", options.scene.title);
  if (!options.case_text.empty()) add_text(*data, "Case", options.case_text);
  const auto writer = writer_of(*data, options.format);
  vtkNew<VtkErrors> errors;
  errors->watch(*writer);
  errors->watch(*writer->GetExecutive());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  set_compressor(*writer, options.compression);
  replace_file(file, [&](const fs::path& temporary) {
    writer->SetFileName(temporary.c_str());
    const bool written = writer->Write() != 0;
    if (const auto code = writer->GetErrorCode(); code != vtkErrorCode::NoError) {
      throw WriteError(file, words_of(code));
    }
    if (!written || errors->any()) throw WriteError(file, errors->first());
    if (!is_complete(temporary)) throw WriteError(file, words_of(vtkErrorCode::OutOfDiskSpaceError));
  });
}

}  // namespace porosph
