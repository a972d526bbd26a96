#include "solver/reference/fem/mesh.hpp"

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "solver/reference/fem/p4_mesh.hpp"
#include "solver/reference/fem/triangle_locator.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {
double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& v : mesh.triangles)
    sum += twice_area(mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]) / 2;
  return sum;
}
}  // namespace

TEST_CASE("The structured mesh fills the rectangle and follows the water") {
  Case scene = test::foundation();
  scene.water.stretches = {{-never, 4.3, 7.1}, {4.3, never, 12}};
  const Mesh mesh = mesh_rectangle(scene, 2);
  CHECK_NOTHROW(check_mesh(mesh, 1));
  CHECK(area(mesh) == Approx(150));
  const auto has = [&](double x, double y) {
    for (const Point& p : mesh.vertices)
      if ((p - Point(x, y)).norm() < 1e-12) return true;
    return false;
  };
  CHECK(has(4.3, 7.1));
  CHECK(mesh.vertices.size() == (3 + 6 + 1) * (4 + 2 + 1));
}

TEST_CASE("The structured mesh refuses what is not one rectangle") {
  Case scene = test::foundation();
  CHECK_THROWS_WITH(mesh_rectangle(scene, 0), Contains("> 0"));
  scene.soils[0].polygon[2].x() = 14;
  CHECK_THROWS_WITH(mesh_rectangle(scene, 1), Contains("not parallel to the axes"));
  scene.soils[0].polygon.pop_back();
  CHECK_THROWS_WITH(mesh_rectangle(scene, 1), Contains("four corners"));
  scene.soils.push_back(scene.soils[0]);
  CHECK_THROWS_WITH(mesh_rectangle(scene, 1), Contains("exactly one soil"));
}

TEST_CASE("A broken mesh is named") {
  Mesh mesh = mesh_rectangle(test::foundation(), 5);
  SECTION("clockwise") {
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    CHECK_THROWS_WITH(check_mesh(mesh, 1), Contains("triangle 3") && Contains("clockwise"));
  }
  SECTION("soil") {
    mesh.soils[2] = 1;
    CHECK_THROWS_WITH(check_mesh(mesh, 1), Contains("soil 1"));
  }
  SECTION("vertex") {
    mesh.triangles[0][1] = 99;
    CHECK_THROWS_WITH(check_mesh(mesh, 1), Contains("names a vertex outside"));
  }
  SECTION("lone vertex") {
    mesh.vertices.emplace_back(1, 1);
    CHECK_THROWS_WITH(check_mesh(mesh, 1), Contains("belongs to no triangle"));
  }
  SECTION("overlap") {
    mesh.triangles.push_back(mesh.triangles[0]);
    mesh.triangles.push_back(mesh.triangles[0]);
    mesh.soils.resize(mesh.triangles.size());
    CHECK_THROWS_WITH(check_mesh(mesh, 1), Contains("more than two triangles"));
  }
}

TEST_CASE("Neighbours share the nodes on their edge, at the same places") {
  const Mesh mesh = mesh_rectangle(test::foundation(), 5);  // 3 x 2 squares
  const P4Mesh nodes = place_nodes(mesh);
  CHECK(nodes.nodes.size() == 13 * 9);
  CHECK(nodes.outline.size() == 10);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < p4::node_count; ++i) {
      Point expected = Point::Zero();
      for (int k = 0; k < 3; ++k) expected += p4::nodes()[i][k] * mesh.vertices[mesh.triangles[t][k]];
      CHECK((nodes.nodes[nodes.triangles[t][i]] - expected).norm() < 1e-12);
    }
}

TEST_CASE("A point is found in each triangle that it touches") {
  const Mesh mesh = mesh_rectangle(test::foundation(), 5);
  const TriangleLocator locator(mesh);
  CHECK(locator.find(mesh, {1, 0.5}).size() == 1);
  CHECK(locator.find(mesh, {2.5, 2.5}).size() == 2);
  CHECK(locator.find(mesh, {5, 5}).size() == 6);
  CHECK(locator.find(mesh, {15, 0}).size() == 1);
  CHECK(locator.find(mesh, {15.001, 10}).empty());
  const auto hit = locator.find(mesh, {1, 0.5}).front();
  Point back = Point::Zero();
  for (int k = 0; k < 3; ++k) back += hit.at[k] * mesh.vertices[mesh.triangles[hit.triangle][k]];
  CHECK((back - Point(1, 0.5)).norm() < 1e-14);
}
