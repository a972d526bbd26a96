#include "vtk_io/fem_mesh.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "fem_scenes.hpp"
#include "solver/reference/fem/mesh_size.hpp"
#include "solver/reference/fem/solve.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

double smallest_angle(const Mesh& mesh) {
  double smallest = 180;
  for (const auto& v : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Point a = mesh.vertices[v[(i + 1) % 3]] - mesh.vertices[v[i]];
      const Point b = mesh.vertices[v[(i + 2) % 3]] - mesh.vertices[v[i]];
      smallest = std::min(smallest, std::acos(a.normalized().dot(b.normalized())) * 180 / M_PI);
    }
  return smallest;
}

}  // namespace

TEST_CASE("The embankment's mesh has good triangles, small ones at the toes") {
  const Case scene = test::embankment();
  for (const double h : {0.3, 0.6, 1.0, 2.0}) {
    CAPTURE(h);
    const Mesh mesh = mesh_case(scene, h);
    CHECK(smallest_angle(mesh) > 15);
    double near_toe = h;
    for (const Point& p : mesh.vertices)
      if (const double d = (p - Point(10, 6)).norm(); d > 0) near_toe = std::min(near_toe, d);
    CHECK(near_toe == Approx(h / 64).epsilon(0.3));
  }
}

TEST_CASE("Only corners with lacking smoothness are refined") {
  const Case scene = test::embankment();
  const MeshSize size = mesh_size(scene, mesh_lines(scene), 0.64);
  CHECK(size.corners.size() == 6);
  CHECK(size({10, 6}) == Approx(0.01));
  CHECK(size({33, 6}) == Approx(0.01));
  CHECK(size({15, 11}) == Approx(0.08));
  CHECK(size({20.5, 11}) == Approx(0.08));
  CHECK(size({12, 8}) == Approx(0.08));
  CHECK(size({28, 8}) == Approx(0.08));
  CHECK(size({15, 10}) == Approx(0.5));
  for (const Point& regular : {Point(0, 0), Point(0, 6), Point(44.4, 6), Point(20, 8), Point(20, 4)})
    CHECK(size(regular) == 0.64);
}

TEST_CASE("Any outline is meshed, at any edge length") {
  Case scene = test::layers(false);
  SoilCase& soil = scene.soils[0];
  scene.soils.pop_back();
  soil.polygon.clear();
  for (int i = 0; i < 80; ++i) {
    const double angle = i * M_PI / 40;
    soil.polygon.emplace_back(10 * std::cos(angle), 6 * std::sin(angle) + 0.3 * std::sin(5 * angle));
  }
  soil.holes = {{}};
  for (int i = 0; i < 40; ++i)
    soil.holes[0].emplace_back(3 + 2 * std::cos(i * M_PI / 20), 1 + std::sin(i * M_PI / 20));
  scene.water.stretches[0].level = 1.2;
  for (double h = 0.5; h < 4; h *= 1.09) {
    CAPTURE(h);
    CHECK(smallest_angle(mesh_case(scene, h)) > 15);
  }
}

TEST_CASE("The mesh follows soils, holes and water") {
  const Case scene = test::layers(true);
  const Mesh mesh = mesh_case(scene, 0.7);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) {
      const Point& p = mesh.vertices[v];
      CHECK((mesh.soils[t] == 0 ? p.y() < 2 + 1e-9 : p.y() > 2 - 1e-9));
      CHECK_FALSE((p.x() > 1.51 && p.x() < 2.49 && p.y() > 3.01 && p.y() < 3.99));
    }
  CHECK_NOTHROW(solve_fem(scene, mesh));
}

TEST_CASE("A hole filled by another soil is an inclusion, and a stretch's end is followed") {
  Case scene = test::layers(true);
  SoilCase stone = scene.soils[0];
  stone.name = "stone";
  stone.polygon = scene.soils[1].holes[0];
  scene.soils.push_back(stone);
  scene.water.stretches = {{-never, 1.7, 5}, {1.7, never, 3.3}};
  const Mesh mesh = mesh_case(scene, 0.5);
  CHECK(std::count(mesh.soils.begin(), mesh.soils.end(), 2) > 2);
  CHECK(solve_fem(scene, mesh).at({2, 3.5}).soil == 2);
}

TEST_CASE("What cannot be meshed is an error") {
  Case scene = test::layers(false);
  CHECK_THROWS_WITH(mesh_case(scene, 0), Contains("must be finite and > 0"));
  scene.soils[1].polygon[0].y() = 1.5;
  CHECK_THROWS_WITH(mesh_case(scene, 0.5), Contains("'clay' and 'sand' overlap"));
  scene.soils.clear();
  CHECK_THROWS_WITH(mesh_case(scene, 0.5), Contains("no soil"));
}
