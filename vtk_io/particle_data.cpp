#include "vtk_io/particle_data.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "solver/fields/field_table.hpp"

namespace porosph {
namespace {

template <typename Array, typename Value>
vtkSmartPointer<Array> borrow(const std::vector<Value>& values, int width) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(width);
  constexpr int leave_to_owner = 1;
  array->SetArray(const_cast<Value*>(values.data()), static_cast<vtkIdType>(values.size()), leave_to_owner);
  return array;
}

vtkSmartPointer<vtkDataArray> borrow(const std::vector<double>& values, int width) {
  return borrow<vtkDoubleArray>(values, width);
}

vtkSmartPointer<vtkDataArray> borrow(const std::vector<std::int32_t>& values, int width) {
  return borrow<vtkTypeInt32Array>(values, width);
}

vtkSmartPointer<vtkDataArray> singles(const std::vector<double>& values, int width) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(width);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::ranges::transform(values, array->GetPointer(0), [](double v) { return static_cast<float>(v); });
  return array;
}

vtkSmartPointer<vtkDataArray> array_of(const FrameField& field, FramePrecision precision) {
  const auto* numbers = std::get_if<std::vector<double>>(&field.values);
  const bool single = numbers != nullptr && precision == FramePrecision::single;
  auto array =
      single ? singles(*numbers, field.width())
             : std::visit([&](const auto& values) { return borrow(values, field.width()); }, field.values);
  array->SetName(field.name.c_str());
  if (const std::string unit = field_unit(field.name); !unit.empty())
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
  for (int c = 0; c < static_cast<int>(field.components.size()); ++c) {
    array->SetComponentName(c, field.components[c].c_str());
  }
  return array;
}

void check(const Frame& frame) {
  if (frame.points.size() % 3 != 0)
    throw std::invalid_argument("frame: points must be 3 numbers per particle");
  const auto particles = frame.points.size() / 3;
  std::set<std::string> names;
  for (const auto& field : frame.fields) {
    const auto size = std::visit([](const auto& values) { return values.size(); }, field.values);
    if (size != particles * field.width()) {
      throw std::invalid_argument(
          fmt::format("frame: field '{}' has {} values for {} particles of {} components", field.name, size,
                      particles, field.width()));
    }
    if (field.name.empty() || !names.insert(field.name).second) {
      throw std::invalid_argument(fmt::format("frame: field name '{}' is empty or occurs twice", field.name));
    }
  }
}

template <typename Array, typename Value>
void add_field_data(vtkPolyData& data, const char* name, Value value) {
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data.GetFieldData()->AddArray(array);
}

std::vector<double> doubles(vtkDataArray& array) {
  const auto width = array.GetNumberOfComponents();
  std::vector<double> values(static_cast<std::size_t>(array.GetNumberOfValues()));
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) array.GetTuple(i, values.data() + i * width);
  return values;
}

FrameField field_of(vtkDataArray& array) {
  FrameField field;
  field.name = array.GetName() != nullptr ? array.GetName() : "";
  const int width = array.GetNumberOfComponents();
  for (int c = 0; width > 1 && c < width; ++c) {
    const char* name = array.GetComponentName(c);
    field.components.push_back(name != nullptr ? name : std::to_string(c));
  }
  if (auto* integers = vtkIntArray::FastDownCast(&array)) {  // 32 bits
    const auto* begin = integers->GetPointer(0);
    field.values = std::vector<std::int32_t>(begin, begin + integers->GetNumberOfValues());
  } else {
    field.values = doubles(array);
  }
  return field;
}

double field_data(vtkPolyData& data, const char* name) {
  auto* array = data.GetFieldData()->GetArray(name);
  return array != nullptr && array->GetNumberOfValues() > 0 ? array->GetComponent(0, 0) : 0;
}

}  // namespace

vtkSmartPointer<vtkCellArray> vertices(vtkIdType particles) {
  vtkNew<vtkIdTypeArray> points, offsets;
  points->SetNumberOfValues(particles);
  offsets->SetNumberOfValues(particles + 1);
  for (vtkIdType i = 0; i < particles; ++i) points->SetValue(i, i);
  for (vtkIdType i = 0; i <= particles; ++i) offsets->SetValue(i, i);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, points);
  return cells;
}

vtkSmartPointer<vtkPolyData> view_of(const Frame& frame, FramePrecision precision) {
  check(frame);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(borrow<vtkDoubleArray>(frame.points, 3));
  data->SetPoints(points);
  data->SetVerts(vertices(points->GetNumberOfPoints()));
  for (const auto& field : frame.fields) data->GetPointData()->AddArray(array_of(field, precision));
  add_field_data<vtkDoubleArray>(*data, time_array, frame.time);
  add_field_data<vtkTypeInt64Array>(*data, step_array, frame.step);
  return data;
}

Frame frame_of(vtkPolyData& data) {
  Frame frame;
  frame.time = field_data(data, time_array);
  frame.step = static_cast<std::int64_t>(field_data(data, step_array));
  if (data.GetPoints() != nullptr) frame.points = doubles(*data.GetPoints()->GetData());
  for (int i = 0; i < data.GetPointData()->GetNumberOfArrays(); ++i) {
    if (auto* array = data.GetPointData()->GetArray(i)) frame.fields.push_back(field_of(*array));
  }
  return frame;
}

}  // namespace porosph
