#include <catch2/catch.hpp>

#include "render/run/particle_cells.hpp"
#include "solver/geometry/moments.hpp"
#include "solver/geometry/place_particles.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

/// A slope of 1 : 2 between level ground at 3 m and at 1 m; 10 m2.
Case slope(Arrangement arrangement) {
  Case scene;
  scene.soils.resize(1);
  scene.soils[0].name = "sand";
  scene.soils[0].polygon = {{0, 0}, {6, 0}, {6, 1}, {5, 1}, {1, 3}, {0, 3}};
  scene.boundaries = {{BoundaryKind::fixed, {0, 0}, {6, 0}},
                      {BoundaryKind::roller, {0, 0}, {0, 3}},
                      {BoundaryKind::roller, {6, 0}, {6, 1}}};
  scene.particles.spacing = 0.25;
  scene.particles.arrangement = arrangement;
  scene.particles.disorder = 0.3;
  return scene;
}

std::vector<Point> starts(const Case& scene) {
  std::vector<Point> positions;
  for (const Site& site : place_particles(scene)) positions.push_back(site.position);
  return positions;
}

}  // namespace

TEST_CASE("the cells of particles fill the soil up to its outline") {
  const auto arrangement = GENERATE(Arrangement::fitted, Arrangement::disordered, Arrangement::surface);
  const Case scene = slope(arrangement);
  const std::vector<Point> at = starts(scene);
  const std::vector<Polygon> cells = particle_cells(scene, at);
  REQUIRE(cells.size() == at.size());
  double area = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (const Point& corner : cells[i]) {
      const Point p = at[i] + corner;
      CHECK(p.y() <= std::clamp(3 - (p.x() - 1) / 2, 1., 3.) + 1e-9);
      CHECK(p.y() >= -1e-9);
    }
    area += cells[i].empty() ? 0.25 * 0.25 : moments({cells[i]}, Point::Zero()).area;
  }
  CHECK(area == Approx(12).epsilon(1e-9));
}

TEST_CASE("the cells of a lattice are squares, as are those of particles without a place") {
  const Case lattice = slope(Arrangement::lattice);
  for (const Polygon& cell : particle_cells(lattice, starts(lattice))) CHECK(cell.empty());
  const Case scene = slope(Arrangement::fitted);
  std::vector<Point> at = starts(scene);
  at[0] = {7, 1};
  CHECK(particle_cells(scene, at)[0].empty());
  at[0].x() = std::numeric_limits<double>::quiet_NaN();
  for (const Polygon& cell : particle_cells(scene, at)) CHECK(cell.empty());
}
