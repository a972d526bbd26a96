#include "render/run/fem_reference.hpp"

#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>
#include <stdexcept>

#include "solver/case/case_file.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

namespace porosph {
namespace {

const std::vector<std::string> vector_components = {"X", "Y", "Z"};
const std::vector<std::string> tensor_components = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

std::map<std::string, std::vector<double>> read_arrays(vtkPointData& data) {
  std::map<std::string, std::vector<double>> arrays;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray& array = *data.GetArray(a);
    const int width = array.GetNumberOfComponents();
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

}  // namespace

FemReference::FemReference(const std::filesystem::path& folder) : scene_(read_case(folder / "case.toml")) {
  const std::filesystem::path file = folder / "fem.vtu";
  if (!std::filesystem::exists(file)) throw ReadError(file, "there is no such file; porosph fem writes it");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(file.c_str())) throw ReadError(file, "it is no .vtu");
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    double p[3];
    grid.GetPoint(i, p);
    mesh_.vertices.push_back({p[0], p[1]});
  }
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
    vtkCell& cell = *grid.GetCell(i);
    if (cell.GetNumberOfPoints() != p4::node_count)
      throw ReadError(file, "it holds cells other than 15-node triangles");
    auto& nodes = triangles_.emplace_back();
    for (int n = 0; n < p4::node_count; ++n)
      nodes[static_cast<std::size_t>(n)] = static_cast<int>(cell.GetPointId(n));
    mesh_.triangles.push_back({nodes[0], nodes[1], nodes[2]});
    mesh_.soils.push_back(0);
  }
  if (triangles_.empty()) throw ReadError(file, "it holds no triangles");
  arrays_ = read_arrays(*grid.GetPointData());
  locator_.emplace(mesh_);
}

bool FemReference::covers(const Point& point) const { return !locator_->find(mesh_, point).empty(); }

std::vector<double> FemReference::values(const FieldSelection& field,
                                         const std::vector<Point>& points) const {
  const auto array = arrays_.find(field.text());
  if (array == arrays_.end())
    throw std::runtime_error(fmt::format("the finite-element reference has no {}", field.text()));
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

}  // namespace porosph
