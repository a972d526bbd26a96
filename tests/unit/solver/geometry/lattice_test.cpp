#include <algorithm>
#include <catch2/catch.hpp>

#include "solver/geometry/place_particles.hpp"
#include "tests/unit/solver/geometry/scenes.hpp"

using namespace porosph;

TEST_CASE("the paper's two scenes have the paper's numbers of particles") {
  CHECK(place_particles(scene_of({rectangle(0, 0, 15, 10)}, 0.2)).size() == 3750);
  CHECK(place_particles(scene_of({embankment()}, 0.2)).size() == 8454);
}

TEST_CASE("lattice sites are cell centres, row by row") {
  const std::vector<Site> sites = place_particles(scene_of({rectangle(1, 2, 4, 4)}, 1.0));
  REQUIRE(sites.size() == 6);
  CHECK(sites[0].position == Point(1.5, 2.5));
  CHECK(sites[2].position == Point(3.5, 2.5));
  CHECK(sites[3].position == Point(1.5, 3.5));
  for (const Site& site : sites) CHECK(site.area == 1.0);
}

TEST_CASE("the orientation of the outline does not matter") {
  Polygon reversed = embankment();
  std::ranges::reverse(reversed);
  CHECK(place_particles(scene_of({reversed}, 0.2)).size() == 8454);
}

TEST_CASE("a hole stays empty") {
  Case scene = scene_of({rectangle(0, 0, 10, 10)}, 1.0);
  scene.soils[0].holes = {rectangle(3, 3, 6, 5)};
  const std::vector<Site> sites = place_particles(scene);
  CHECK(sites.size() == 94);
  for (const Site& site : sites) {
    const Point& p = site.position;
    CHECK_FALSE((p.x() > 3 && p.x() < 6 && p.y() > 3 && p.y() < 5));
  }
}

TEST_CASE("centres on the border of two soils go to the first") {
  const Case scene = scene_of({rectangle(0, 0, 2, 1.5), rectangle(0, 1.5, 2, 3)}, 1.0);
  const std::vector<Site> sites = place_particles(scene);
  REQUIRE(sites.size() == 6);
  CHECK(std::ranges::count(sites, 0, &Site::soil) == 4);
}

TEST_CASE("what cannot be filled is named") {
  CHECK_THROWS_WITH(place_particles(scene_of({rectangle(0, 0, 2, 2), rectangle(1, 1, 3, 3)}, 0.1)),
                    Catch::Contains("'soil 1' and 'soil 2' overlap by 1 m2"));
  CHECK_THROWS_WITH(place_particles(scene_of({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, 0.1)),
                    Catch::Contains("soil 'soil 1'") && Catch::Contains("simple"));
  CHECK_THROWS_WITH(place_particles(scene_of({rectangle(0, 0, 9, 1), rectangle(0, 1, 9, 1.1)}, 1.0)),
                    Catch::Contains("'soil 2' is too thin"));
}
