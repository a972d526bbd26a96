#include "vtk_io/read_series.hpp"

#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "vtk_io/particle_data.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {
namespace fs = std::filesystem;

namespace {

vtkSmartPointer<vtkXMLReader> reader_for(const fs::path& file) {
  if (file.extension() == ".vtp") return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  if (file.extension() == ".vtu") return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  throw ReadError(file, "a frame is a .vtp or a .vtu file");
}

}  // namespace

Series open_series(const fs::path& pvd) {
  Series series{pvd.parent_path(), read_pvd(pvd)};
  if (series.frames.empty()) throw ReadError(pvd, "it names no frames");
  return series;
}

vtkSmartPointer<vtkPolyData> read_frame(const fs::path& file) {
  const auto reader = reader_for(file);
  vtkNew<VtkErrors> errors;
  errors->watch(*reader);
  errors->watch(*reader->GetExecutive());
  reader->SetReaderErrorObserver(errors);
  reader->SetParserErrorObserver(errors);
  reader->SetFileName(file.c_str());
  reader->Update();
  if (errors->any()) throw ReadError(file, errors->first());
  auto* set = vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(set->GetPoints());
  data->GetPointData()->ShallowCopy(set->GetPointData());
  data->GetFieldData()->ShallowCopy(set->GetFieldData());
  data->SetVerts(vertices(data->GetNumberOfPoints()));
  return data;
}

}  // namespace porosph
