#include "vtk_io/read_series.hpp"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <limits>
#include <map>

#include "vtk_io/appended_data.hpp"
#include "vtk_io/frame_head.hpp"
#include "vtk_io/particle_data.hpp"
#include "vtk_io/run_folder/atomic_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {
namespace fs = std::filesystem;

namespace {

const std::map<std::string, int> array_types = {
    {"Int8", VTK_TYPE_INT8},       {"UInt8", VTK_TYPE_UINT8},   {"Int16", VTK_TYPE_INT16},
    {"UInt16", VTK_TYPE_UINT16},   {"Int32", VTK_TYPE_INT32},   {"UInt32", VTK_TYPE_UINT32},
    {"Int64", VTK_TYPE_INT64},     {"UInt64", VTK_TYPE_UINT64}, {"Float32", VTK_TYPE_FLOAT32},
    {"Float64", VTK_TYPE_FLOAT64},
};

class FrameReader {
 public:
  explicit FrameReader(const fs::path& file)
      : file_(file), text_(read_file(file)), head_(read_head(file, text_)), data_(file, head_, text_) {}

  vtkSmartPointer<vtkPolyData> read() const {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    result->SetPoints(points);
    for (const auto& head : head_.arrays) {
      if (head.type == "String" && head.section == "FieldData") continue;  // remarks of other programs
      add(*result, head.section, array_of(head));
    }
    check_points(*result);
    result->SetVerts(vertices(result->GetNumberOfPoints()));
    return result;
  }

 private:
  void add(vtkPolyData& result, const std::string& section, vtkDataArray* array) const {
    if (section == "FieldData") {
      result.GetFieldData()->AddArray(array);
    } else if (section == "PointData") {
      result.GetPointData()->AddArray(array);
    } else {
      if (array->GetNumberOfComponents() != 3) throw ReadError(file_, "its points do not have 3 coordinates");
      result.GetPoints()->SetData(array);
    }
  }

  vtkSmartPointer<vtkDataArray> array_of(const ArrayHead& head) const {
    const auto type = array_types.find(head.type);
    if (type == array_types.end()) {
      throw ReadError(file_, fmt::format("array {}: unknown type '{}'", head.name, head.type));
    }
    vtkSmartPointer<vtkDataArray> array;
    array.TakeReference(vtkDataArray::CreateDataArray(type->second));
    array->SetName(head.name.c_str());
    allocate(*array, head);
    for (std::size_t c = 0; c < head.component_names.size(); ++c) {
      array->SetComponentName(static_cast<vtkIdType>(c), head.component_names[c].c_str());
    }
    const auto bytes = static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
    data_.read(head.name, head.offset, {static_cast<unsigned char*>(array->GetVoidPointer(0)), bytes});
    return array;
  }

  void allocate(vtkDataArray& array, const ArrayHead& head) const {
    const auto limit = data_.largest_array() / array.GetDataTypeSize();
    const bool fits = head.components > 0 && head.components <= std::numeric_limits<int>::max() &&
                      head.tuples <= limit / head.components;
    if (!fits) {
      throw ReadError(file_, fmt::format("array {}: the file is too small for {} x {} values", head.name,
                                         head.tuples, head.components));
    }
    array.SetNumberOfComponents(static_cast<int>(head.components));
    array.SetNumberOfTuples(static_cast<vtkIdType>(head.tuples));
  }

  void check_points(vtkPolyData& result) const {
    if (static_cast<std::uint64_t>(result.GetNumberOfPoints()) != head_.points) {
      throw ReadError(file_, "the array of its points is missing");
    }
  }

  const fs::path& file_;
  std::string text_;
  FrameHead head_;
  AppendedData data_;
};

}  // namespace

Series open_series(const fs::path& pvd) {
  Series series{pvd.parent_path(), read_pvd(pvd)};
  if (series.frames.empty()) throw ReadError(pvd, "it names no frames");
  return series;
}

vtkSmartPointer<vtkPolyData> read_frame(const fs::path& file) { return FrameReader(file).read(); }

}  // namespace porosph
