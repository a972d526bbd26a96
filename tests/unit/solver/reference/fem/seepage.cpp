#include "solver/reference/fem/seepage.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/solver/water/scenes.hpp"

using namespace porosph;
using namespace porosph::test;

TEST_CASE("finite elements give uniform flow exactly", "[fem][water]") {
  Case scene = seepage_box(2, 1, 0.1);
  scene.water.faces.push_back(head_face({0, 0}, {0, 1}, 5));
  scene.water.faces.push_back(head_face({2, 0}, {2, 1}, 4));
  const Mesh mesh = mesh_rectangle(scene, 0.5);
  const P4Mesh nodes = place_nodes(mesh);
  const FemSeepage s = solve_fem_seepage(scene, mesh, nodes);
  for (std::size_t n = 0; n < nodes.nodes.size(); ++n)
    CHECK(s.head[n] == Approx(5 - nodes.nodes[n].x() / 2).epsilon(1e-9));
  CHECK(s.through_faces[1] == Approx(0.5 * scene.soils[0].permeability.x()));
  CHECK(s.through_faces[2] == Approx(-s.through_faces[1]));
}

TEST_CASE("particles and finite elements agree on the seepage under a weir", "[fem][water]") {
  const double half_width = GENERATE(0.3, 0.5);
  Case scene = seepage_box(2, 1, 0.05);
  scene.water.faces.push_back(head_face({0, 1}, {1 - half_width, 1}, 3));
  scene.water.faces.push_back(head_face({1 + half_width, 1}, {2, 1}, 2));
  const Mesh mesh = mesh_rectangle(scene, 0.1);
  const FemSeepage by_elements = solve_fem_seepage(scene, mesh, place_nodes(mesh));
  const Seepage by_particles(scene);
  CHECK(by_particles.through[1] == Approx(by_elements.through_faces[1]).epsilon(0.04));
  CHECK(by_elements.through_faces[2] == Approx(-by_elements.through_faces[1]).epsilon(1e-8));
}

TEST_CASE("finite elements find the discharge of a dam with a seepage face", "[fem][water]") {
  Case scene = seepage_box(5, 10, 0.5);
  scene.soils[0].retention = {.model = RetentionModel::gardner, .alpha = 4};
  scene.water.faces.push_back(head_face({0, 0}, {0, 10}, 10));
  scene.water.faces.push_back(head_face({5, 0}, {5, 10}, 2));
  const Mesh mesh = mesh_rectangle(scene, 1);
  const FemSeepage by_elements = solve_fem_seepage(scene, mesh, place_nodes(mesh));
  const Seepage by_particles(scene);
  const double k = scene.soils[0].permeability.x();
  CHECK(by_elements.through_faces[1] / k == Approx(9.6).epsilon(0.03));  // (H1^2 - H2^2) / 2 L
  CHECK(by_particles.through[1] == Approx(by_elements.through_faces[1]).epsilon(0.005));
}
