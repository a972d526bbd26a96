// What finite elements cost, told before they are solved; and long thin sections, which once had no end.
#include <catch2/catch.hpp>
#include <cmath>

#include "fem_scenes.hpp"
#include "solver/reference/fem/constraints.hpp"
#include "solver/reference/fem/demand.hpp"
#include "solver/reference/fem/solve.hpp"
#include "vtk_io/fem_mesh.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

/// Dry ground on a fixed base.
Case section(double length, double height) {
  Case scene;
  SoilCase soil;
  soil.name = "sand";
  soil.polygon = {{0, 0}, {length, 0}, {length, height}, {0, height}};
  soil.youngs_modulus = 15e6;
  soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20e3;
  scene.soils = {soil};
  scene.boundaries = {{BoundaryKind::fixed, {0, 0}, {length, 0}}};
  return scene;
}

}  // namespace

TEST_CASE("The number of unknowns is known before the mesh is made") {
  for (const Case& scene : {test::embankment(), test::layers(true), section(300, 2), section(40, 20)})
    for (const double triangles : {500.0, 2000.0, 5000.0}) {
      const double h = fem_edge(scene, triangles);
      const Mesh mesh = mesh_case(scene, h);
      const int unknowns = constrain(scene, mesh, place_nodes(mesh)).unknowns;
      CAPTURE(triangles, unknowns);
      const FemDemand demand = fem_demand(scene, h);
      CHECK(demand.triangles == Approx(static_cast<double>(mesh.triangles.size())).epsilon(0.03));
      CHECK(demand.unknowns == Approx(unknowns).epsilon(0.2));
    }
}

TEST_CASE("What no memory holds is refused at once, with the numbers of it") {
  const Case scene = section(1000, 1);
  for (const double h : {0.05, 1e-4, 1e-9}) {
    const FemDemand demand = fem_demand(scene, h);
    CHECK(demand.unknowns == Approx(16 * 1000 / (std::sqrt(3.0) / 4 * h * h)));
    CHECK_THROWS_WITH(check_fem_demand(demand, 1e12), Contains("unknowns") && Contains("at most 1e+07"));
  }
  CHECK_THROWS_WITH(check_fem_demand(fem_demand(scene, 0.3), 5e8), Contains("GB of memory; there is 0.5 GB"));
  CHECK_NOTHROW(check_fem_demand(fem_demand(scene, 1), 5e8));
  CHECK_THROWS_WITH(fem_demand(scene, 1e9), Contains("1e+09 m, but the section measures 1000 m"));
  CHECK_THROWS_WITH(fem_demand(scene, -1), Contains("must be finite and > 0"));
}

// Far from its ends a long section is a column, whose stress is its weight.
TEST_CASE("Long and thin sections are meshed, upright, level or inclined") {
  for (const double length : {100.0, 1000.0, 2000.0, 10000.0})
    for (const double height : {0.7, 1.0, 3.0}) {
      const Case scene = section(length, height);
      const double h = fem_edge(scene, 2000);
      CAPTURE(length, height, h);
      const FemSolution solution = solve_fem(scene, mesh_case(scene, h));
      const FemPoint middle = solution.at({length / 2, height / 4});
      CHECK(middle.effective_stress[1] == Approx(-20e3 * height * 0.75).epsilon(1e-6));
    }
  for (const Point& along : {Point(700, 700), Point(30, 900), Point(900, 30)}) {
    Case scene = section(1, 1);
    const Point across = Point(-along.y(), along.x()).normalized();
    scene.soils[0].polygon = {{0, 0}, along, along + across, across};
    scene.boundaries[0].to = along;
    const double h = fem_edge(scene, 2000);
    CAPTURE(along.x(), along.y());
    const FemPoint middle = solve_fem(scene, mesh_case(scene, h)).at((along + across) / 2);
    const Eigen::Vector4d& s = middle.effective_stress;
    Eigen::Matrix2d stress;
    stress << s[0], s[3], s[3], s[1];
    const Point traction = stress * across;  // carries the weight of the half metre above
    CHECK(traction.x() == Approx(0).margin(0.02 * 10e3));
    CHECK(traction.y() == Approx(-10e3).epsilon(0.02));
  }
}
