#include "vtk_io/fem_vtu.hpp"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <map>
#include <utility>

#include "vtk_io/write_appended.hpp"

namespace porosph {
namespace {

/// The nodes of each soil with all readings there, and which of them make up the triangles.
struct SoilPoints {
  std::vector<Point> points;
  std::vector<std::vector<FemPoint>> readings;
  std::vector<std::array<vtkIdType, p4::node_count>> triangles;
};

SoilPoints points_by_soil(const FemSolution& solution) {
  SoilPoints result;
  const auto& nodes = solution.p4_mesh();
  std::map<std::pair<int, int>, vtkIdType> known;  // (node, soil) -> point
  for (int t = 0; t < static_cast<int>(nodes.triangles.size()); ++t) {
    auto& triangle = result.triangles.emplace_back();
    for (int i = 0; i < p4::node_count; ++i) {
      const int node = nodes.triangles[t][i];
      const auto [entry, added] = known.try_emplace({node, solution.mesh().soils[t]}, result.points.size());
      if (added) {
        result.points.push_back(nodes.nodes[node]);
        result.readings.emplace_back();
      }
      result.readings[entry->second].push_back(solution.in_triangle(t, p4::nodes()[i]));
      triangle[i] = entry->second;
    }
  }
  return result;
}

vtkNew<vtkDoubleArray> new_array(const char* name, std::initializer_list<const char*> components,
                                 vtkIdType count) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(std::max(1, static_cast<int>(components.size())));
  vtkIdType c = 0;
  for (const char* component : components) array->SetComponentName(c++, component);
  array->SetNumberOfTuples(count);
  return array;
}

void set_stress(vtkDoubleArray* array, vtkIdType point, const Eigen::Vector4d& s) {
  array->SetTuple6(point, s[0], s[1], s[2], s[3], 0, 0);
}

vtkNew<vtkUnstructuredGrid> grid_of(const FemSolution& solution) {
  const SoilPoints soil_points = points_by_soil(solution);
  const auto count = static_cast<vtkIdType>(soil_points.points.size());
  const auto displacement = new_array("Displacement", {"X", "Y", "Z"}, count);
  const auto effective = new_array("EffectiveStress", {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}, count);
  const auto total = new_array("TotalStress", {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}, count);
  const auto pore_pressure = new_array("PorePressure", {}, count);
  vtkNew<vtkIntArray> soil;
  soil->SetName("SoilId");
  soil->SetNumberOfTuples(count);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const FemPoint p = mean(soil_points.readings[i]);
    points->SetPoint(i, soil_points.points[i].x(), soil_points.points[i].y(), 0);
    displacement->SetTuple3(i, p.displacement.x(), p.displacement.y(), 0);
    set_stress(effective, i, p.effective_stress);
    set_stress(total, i, p.total_stress());
    pore_pressure->SetValue(i, p.pore_pressure);
    soil->SetValue(i, p.soil);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->Allocate(static_cast<vtkIdType>(soil_points.triangles.size()));
  for (const auto& triangle : soil_points.triangles)
    grid->InsertNextCell(VTK_LAGRANGE_TRIANGLE, p4::node_count, triangle.data());
  for (vtkDataArray* array : {displacement.Get(), effective.Get(), total.Get(), pore_pressure.Get()})
    grid->GetPointData()->AddArray(array);
  grid->GetPointData()->AddArray(soil);
  return grid;
}

}  // namespace

void write_fem_vtu(const FemSolution& solution, const std::filesystem::path& file) {
  const auto grid = grid_of(solution);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_appended(*writer, file);
}

}  // namespace porosph
