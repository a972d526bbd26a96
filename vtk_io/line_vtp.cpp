#include "vtk_io/line_vtp.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "vtk_io/write_appended.hpp"

namespace porosph {
namespace {

vtkNew<vtkPolyData> poly_data(const std::vector<std::vector<Point>>& lines, const std::string& name,
                              const std::vector<double>& values) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    cells->InsertNextCell(static_cast<int>(lines[i].size()));
    for (const Point& p : lines[i]) cells->InsertCellPoint(points->InsertNextPoint(p.x(), p.y(), 0));
    array->InsertNextValue(values[i]);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  data->GetCellData()->AddArray(array);
  return data;
}

}  // namespace

void write_lines_vtp(const std::filesystem::path& file, const std::vector<std::vector<Point>>& lines,
                     const std::string& name, const std::vector<double>& values) {
  const auto data = poly_data(lines, name, values);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  write_appended(*writer, file);
}

}  // namespace porosph
