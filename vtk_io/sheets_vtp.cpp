#include "vtk_io/sheets_vtp.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>

#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/write_appended.hpp"

namespace porosph {
namespace {

using Node = SheetFrame::Node;
struct Quantity {
  const char* name;
  double Node::*value;
};
constexpr std::array quantities = {Quantity{"AxialForce", &Node::axial}, Quantity{"ShearForce", &Node::shear},
                                   Quantity{"BendingMoment", &Node::moment}};

template <class Array>
vtkNew<Array> named(const char* name, int components = 1) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}

vtkDataArray& array_in(const std::filesystem::path& file, vtkPolyData& data, const char* name,
                       int components) {
  vtkDataArray* array = data.GetPointData()->GetArray(name);
  if (array == nullptr || array->GetNumberOfComponents() != components ||
      array->GetNumberOfTuples() != data.GetNumberOfPoints())
    throw ReadError(file, fmt::format("it has no point data {}", name));
  return *array;
}

}  // namespace

void write_sheets_vtp(const std::filesystem::path& file, const std::vector<SheetFrame>& sheets) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  const auto moved = named<vtkDoubleArray>("Displacement", 3);
  const auto id = named<vtkIntArray>("SheetId");
  vtkNew<vtkPolyData> data;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    lines->InsertNextCell(static_cast<int>(sheets[i].nodes.size()));
    for (const Node& n : sheets[i].nodes) {
      lines->InsertCellPoint(points->InsertNextPoint(n.x + n.u_x, n.y + n.u_y, 0));
      moved->InsertNextTuple3(n.u_x, n.u_y, 0);
      id->InsertNextValue(static_cast<int>(i));
    }
  }
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetPointData()->AddArray(moved);
  data->GetPointData()->AddArray(id);
  for (const Quantity& quantity : quantities) {
    const auto array = named<vtkDoubleArray>(quantity.name);
    for (const SheetFrame& sheet : sheets)
      for (const Node& node : sheet.nodes) array->InsertNextValue(node.*quantity.value);
    data->GetPointData()->AddArray(array);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  write_appended(*writer, file);
}

std::vector<SheetFrame> read_sheets_vtp(const std::filesystem::path& file) {
  const auto data = read_frame(file);
  vtkDataArray& id = array_in(file, *data, "SheetId", 1);
  vtkDataArray& moved = array_in(file, *data, "Displacement", 3);
  std::vector<SheetFrame> sheets;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    if (i == 0 || id.GetComponent(i, 0) != id.GetComponent(i - 1, 0)) sheets.emplace_back();
    const double* at = data->GetPoint(i);
    Node node{.u_x = moved.GetComponent(i, 0), .u_y = moved.GetComponent(i, 1)};
    node.x = at[0] - node.u_x, node.y = at[1] - node.u_y;
    for (const Quantity& quantity : quantities)
      node.*quantity.value = array_in(file, *data, quantity.name, 1).GetComponent(i, 0);
    sheets.back().nodes.push_back(node);
  }
  return sheets;
}

}  // namespace porosph
