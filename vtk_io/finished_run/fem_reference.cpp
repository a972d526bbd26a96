#include "vtk_io/finished_run/fem_reference.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>
#include <new>
#include <stdexcept>

#include "solver/analysis/derived_fields.hpp"
#include "solver/case/case_file.hpp"
#include "vtk_io/read_series.hpp"
#include "vtk_io/run_folder/file_errors.hpp"
#include "vtk_io/vtk_errors.hpp"

namespace porosph {
namespace {

const std::vector<std::string> vector_components = {"X", "Y", "Z"};
const std::vector<std::string> tensor_components = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

std::map<std::string, std::vector<double>> read_arrays(const std::filesystem::path& file,
                                                       vtkPointData& data) {
  std::map<std::string, std::vector<double>> arrays;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray& array = *data.GetArray(a);
    const int width = array.GetNumberOfComponents();
    if (width != 1 && width != 3 && width != 6)
      throw ReadError(file, "it has an array of unknown components");
    for (int c = 0; c < width; ++c) {
      const FieldSelection name{array.GetName(), width == 1 ? ""
                                                 : width == 3
                                                     ? vector_components[static_cast<std::size_t>(c)]
                                                     : tensor_components.at(static_cast<std::size_t>(c))};
      auto& values = arrays[name.text()];
      for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) values.push_back(array.GetComponent(i, c));
    }
  }
  return arrays;
}

/// Names and components of the arrays, whose widths were checked.
std::vector<FrameField> fields_of(vtkPointData& data) {
  std::vector<FrameField> fields;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray& array = *data.GetArray(a);
    const int width = array.GetNumberOfComponents();
    fields.push_back({array.GetName(),
                      width == 1   ? std::vector<std::string>{}
                      : width == 3 ? vector_components
                                   : tensor_components,
                      std::vector<double>{}});
  }
  return fields;
}

/// VTK's reader takes sizes from the file as they are and says little: the sizes are looked at first.
void read_grid(const std::filesystem::path& file, vtkXMLUnstructuredGridReader& reader) {
  read_frame(file);
  vtkNew<VtkErrors> errors;
  errors->watch(reader);
  reader.SetFileName(file.c_str());
  try {
    reader.Update();
  } catch (const std::bad_alloc&) {
    throw ReadError(file, "it asks for more memory than there is");
  }
  if (errors->any()) throw ReadError(file, errors->first());
}

/// The nodes of cell i. Nothing that the file says of them is relied on.
std::array<int, p4::node_count> nodes_of(const std::filesystem::path& file, vtkUnstructuredGrid& grid,
                                         vtkIdType i) {
  vtkCellArray& cells = *grid.GetCells();
  const auto begin = static_cast<vtkIdType>(cells.GetOffsetsArray()->GetComponent(i, 0)),
             end = static_cast<vtkIdType>(cells.GetOffsetsArray()->GetComponent(i + 1, 0));
  if (begin < 0 || end > cells.GetConnectivityArray()->GetNumberOfTuples() || end - begin != p4::node_count)
    throw ReadError(file, "it holds cells other than 15-node triangles");
  std::array<int, p4::node_count> nodes{};
  for (int n = 0; n < p4::node_count; ++n) {
    const double node = cells.GetConnectivityArray()->GetComponent(begin + n, 0);
    if (!(node >= 0 && node < static_cast<double>(grid.GetNumberOfPoints())))
      throw ReadError(file, "its triangles have nodes that are not there");
    nodes[static_cast<std::size_t>(n)] = static_cast<int>(node);
  }
  return nodes;
}

}  // namespace

FemReference::FemReference(const std::filesystem::path& folder) : scene_(read_case(folder / "case.toml")) {
  const std::filesystem::path file = folder / "fem.vtu";
  if (!std::filesystem::exists(file)) throw ReadError(file, "there is no such file; porosph fem writes it");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read_grid(file, *reader);
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    double p[3];
    grid.GetPoint(i, p);
    mesh_.vertices.push_back({p[0], p[1]});
  }
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
    const auto& nodes = triangles_.emplace_back(nodes_of(file, grid, i));
    mesh_.triangles.push_back({nodes[0], nodes[1], nodes[2]});
    mesh_.soils.push_back(0);
  }
  if (triangles_.empty()) throw ReadError(file, "it holds no triangles");
  arrays_ = read_arrays(file, *grid.GetPointData());
  fields_ = fields_of(*grid.GetPointData());
  locator_.emplace(mesh_);
}

bool FemReference::covers(const Point& point) const { return !locator_->find(mesh_, point).empty(); }

std::vector<double> FemReference::values(const FieldSelection& field,
                                         const std::vector<Point>& points) const {
  const auto array = arrays_.find(field.text());
  if (array == arrays_.end()) {
    const Frame all = state(points);
    if (has_field(all, field.name) || !can_show(all, field.name))
      throw std::runtime_error(fmt::format("the finite-element reference has no {}", field.text()));
    return values_of(all, field);
  }
  std::vector<double> out;
  for (const Point& point : points) {
    const auto hits = locator_->find(mesh_, point);
    double sum = hits.empty() ? std::numeric_limits<double>::quiet_NaN() : 0;
    for (const auto& hit : hits) {
      const p4::Values shape = p4::values(hit.at);
      const auto& nodes = triangles_[static_cast<std::size_t>(hit.triangle)];
      for (int n = 0; n < p4::node_count; ++n)
        sum += shape[n] * array->second[static_cast<std::size_t>(nodes[static_cast<std::size_t>(n)])] /
               static_cast<double>(hits.size());
    }
    out.push_back(sum);
  }
  return out;
}

Frame FemReference::state(const std::vector<Point>& points) const {
  Frame frame;
  for (FrameField field : fields_) {
    const auto width = static_cast<std::size_t>(field.width());
    std::vector<double> all(width * points.size());
    for (std::size_t c = 0; c < width; ++c) {
      const auto one = values({field.name, width == 1 ? "" : field.components[c]}, points);
      for (std::size_t i = 0; i < one.size(); ++i) all[i * width + c] = one[i];
    }
    field.values = std::move(all);
    frame.fields.push_back(std::move(field));
  }
  for (const Point& p : points) frame.points.insert(frame.points.end(), {p.x(), p.y(), 0});
  if (scene_.water.present()) {  // their pressure is that at the places at t = 0
    add_water_unit_weight(frame, scene_.water.unit_weight);
    if (auto head = derived_field(frame, "Head")) frame.fields.push_back(std::move(*head));
  }
  const auto u_x = values({"Displacement", "X"}, points), u_y = values({"Displacement", "Y"}, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    frame.points[3 * i] += u_x[i];
    frame.points[3 * i + 1] += u_y[i];
  }
  return frame;
}

}  // namespace porosph
