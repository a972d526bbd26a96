#include "vtk_io/fem_vtu.hpp"

#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "fem_scenes.hpp"
#include "solver/reference/fem/solve.hpp"
#include "tests/unit/run_folder/temporary_folder.hpp"
#include "vtk_io/fem_mesh.hpp"
#include "vtk_io/run_folder/file_errors.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// VTK's own interpolation of an array's component in a cell.
double interpolate(vtkUnstructuredGrid* grid, vtkIdType cell, const double* parametric, const char* name,
                   int c) {
  double weights[p4::node_count];
  grid->GetCell(cell)->InterpolateFunctions(parametric, weights);
  double value = 0;
  for (int i = 0; i < p4::node_count; ++i)
    value += weights[i] *
             grid->GetPointData()->GetArray(name)->GetComponent(grid->GetCell(cell)->GetPointId(i), c);
  return value;
}

}  // namespace

TEST_CASE("VTK reads back the reference: places, displacement and stress inside the curved triangles") {
  const Case scene = test::layers(true);
  const FemSolution solution = solve_fem(scene, mesh_case(scene, 0.7));
  const test::TemporaryFolder folder;
  const auto path = folder / "fem.vtu";
  write_fem_vtu(solution, path);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == static_cast<vtkIdType>(solution.mesh().triangles.size()));
  const auto stress = grid->GetPointData()->GetArray("EffectiveStress");
  REQUIRE(stress->GetNumberOfComponents() == 6);
  CHECK(std::string(stress->GetComponentName(3)) == "XY");
  CHECK(std::string(stress->GetComponentName(4)) == "YZ");

  const double parametric[3] = {0.23, 0.41, 0};
  const p4::Barycentric at(1 - 0.23 - 0.41, 0.23, 0.41);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    REQUIRE(grid->GetCellType(cell) == VTK_LAGRANGE_TRIANGLE);
    const FemPoint here = solution.in_triangle(static_cast<int>(cell), at);
    double place[3], weights[p4::node_count];
    int sub = 0;
    grid->GetCell(cell)->EvaluateLocation(sub, parametric, place, weights);
    Point expected = Point::Zero();
    for (int k = 0; k < 3; ++k)
      expected += at[k] * solution.mesh().vertices[solution.mesh().triangles[cell][k]];
    CHECK((Point(place[0], place[1]) - expected).norm() < 1e-9);
    CHECK(interpolate(grid, cell, parametric, "Displacement", 0) ==
          Approx(here.displacement.x()).margin(1e-12));
    CHECK(interpolate(grid, cell, parametric, "Displacement", 1) ==
          Approx(here.displacement.y()).margin(1e-12));
    CHECK(interpolate(grid, cell, parametric, "PorePressure", 0) == Approx(here.pore_pressure).margin(1e-6));
    CHECK(interpolate(grid, cell, parametric, "SoilId", 0) == Approx(here.soil).margin(1e-12));
  }
}

TEST_CASE("Each point of the file holds what the solution says there, and soils keep their own stress") {
  const Case scene = test::layers(false);
  const FemSolution solution = solve_fem(scene, mesh_case(scene, 1));
  const test::TemporaryFolder folder;
  const auto path = folder / "fem.vtu";
  write_fem_vtu(solution, path);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPointData* data = reader->GetOutput()->GetPointData();
  int interface_points[2] = {0, 0};
  for (vtkIdType i = 0; i < reader->GetOutput()->GetNumberOfPoints(); ++i) {
    const double* place = reader->GetOutput()->GetPoint(i);
    const int soil = static_cast<int>(data->GetArray("SoilId")->GetTuple1(i));
    const double k0 = soil == 0 ? 0.4 / 0.6 : 0.2 / 0.8;
    double effective[6], total[6];
    data->GetArray("EffectiveStress")->GetTuple(i, effective);
    data->GetArray("TotalStress")->GetTuple(i, total);
    CHECK(effective[0] == Approx(k0 * effective[1]).margin(1e-3));
    CHECK(effective[2] == Approx(k0 * effective[1]).margin(1e-3));
    CHECK((effective[4] == 0 && effective[5] == 0));
    const FemPoint p = solution.at({place[0], place[1]});
    for (int c = 0; c < 3; ++c) CHECK(total[c] == Approx(effective[c] + p.pore_pressure).margin(1e-6));
    if (std::abs(place[1] - 2) < 1e-9) ++interface_points[soil];
    if (p.soil == soil) CHECK(effective[1] == Approx(p.effective_stress[1]).margin(1e-6));
  }
  CHECK(interface_points[0] == 4 * 4 + 1);
  CHECK(interface_points[1] == 4 * 4 + 1);
}

TEST_CASE("A file that cannot be written is an error that names it") {
  const Case scene = test::layers(false);
  const FemSolution solution = solve_fem(scene, mesh_case(scene, 2));
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(write_fem_vtu(solution, folder / "no such folder/fem.vtu"), WriteError);
  const test::FileSizeLimit full_disk(2000);
  CHECK_THROWS_WITH(write_fem_vtu(solution, folder / "fem.vtu"), Contains("fem.vtu"));
  CHECK(test::names_in(folder.path()).empty());
}
