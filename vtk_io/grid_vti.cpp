#include "vtk_io/grid_vti.hpp"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>

#include <limits>

#include "solver/particles/field_table.hpp"
#include "vtk_io/particle_data.hpp"
#include "vtk_io/write_appended.hpp"

namespace porosph {
namespace {

vtkNew<vtkDoubleArray> array_of(const FrameField& field, const GridValues& grid) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  const int width = field.width();
  array->SetNumberOfComponents(width);
  for (int c = 0; c < static_cast<int>(field.components.size()); ++c)
    array->SetComponentName(c, field.components[static_cast<std::size_t>(c)].c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(grid.in_soil.size()));
  if (const std::string unit = field_unit(field.name); !unit.empty())
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
  const auto& values = std::get<std::vector<double>>(field.values);
  std::size_t next = 0;
  for (std::size_t node = 0; node < grid.in_soil.size(); ++node)
    for (int c = 0; c < width; ++c)
      array->SetComponent(static_cast<vtkIdType>(node), c,
                          grid.in_soil[node] ? values[next++] : std::numeric_limits<double>::quiet_NaN());
  return array;
}

}  // namespace

void write_grid_vti(const std::filesystem::path& file, const GridValues& grid) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.columns, grid.rows, 1);
  image->SetOrigin(grid.low.x(), grid.low.y(), 0);
  image->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
  for (const FrameField& field : grid.values.fields) image->GetPointData()->AddArray(array_of(field, grid));
  vtkNew<vtkUnsignedCharArray> in_soil;
  in_soil->SetName("InSoil");
  for (const bool is_in : grid.in_soil) in_soil->InsertNextValue(is_in ? 1 : 0);
  image->GetPointData()->AddArray(in_soil);
  vtkNew<vtkDoubleArray> time;
  time->SetName(time_array);
  time->InsertNextValue(grid.values.time);
  image->GetFieldData()->AddArray(time);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  write_appended(*writer, file);
}

}  // namespace porosph
