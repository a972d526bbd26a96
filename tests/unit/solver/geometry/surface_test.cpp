#include <algorithm>
#include <catch2/catch.hpp>

#include "solver/geometry/bands.hpp"
#include "solver/geometry/place_particles.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/unit/solver/geometry/scenes.hpp"

using namespace porosph;

namespace {

Case column(double spacing) {
  Case scene = scene_of({rectangle(0, 0, 2, 10)}, spacing, Arrangement::surface);
  hold_as_column(scene);
  return scene;
}

Case held_embankment(double spacing) {
  Case scene = scene_of({embankment()}, spacing, Arrangement::surface);
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {44.4, 0});
  add_wall(scene, BoundaryKind::roller, {0, 0}, {0, 8});
  add_wall(scene, BoundaryKind::roller, {44.4, 0}, {44.4, 8});
  return scene;
}

}  // namespace

TEST_CASE("surface sites: half a cell on free ground, whole cells from wall to wall") {
  const std::vector<Site> sites = place_particles(column(0.5));
  REQUIRE(sites.size() == 4 * 21);
  const double high = 10 / 20.5;
  CHECK(sites.front().position.isApprox(Point(0.25, high / 2)));
  CHECK(sites.front().area == Approx(0.5 * high));
  CHECK(sites.front().fill == Approx(1));
  CHECK(sites.back().position.isApprox(Point(1.75, 10)));
  CHECK(sites.back().area == Approx(0.25 * high));
  CHECK(sites.back().fill == Approx(0.5));
}

TEST_CASE("surface sites: a quarter of a cell in a free corner") {
  const std::vector<Site> sites = place_particles(scene_of({rectangle(0, 0, 3, 2)}, 1, Arrangement::surface));
  REQUIRE(sites.size() == 12);
  CHECK(sites.front().position.isApprox(Point(0, 0)));
  CHECK(sites.front().fill == Approx(0.25));
  CHECK(sites[1].fill == Approx(0.5));
  CHECK(sites[5].fill == Approx(1));
}

TEST_CASE("surface sites: layers meet between two rows") {
  Case scene = scene_of({rectangle(0, 0, 4, 2), rectangle(0, 2, 4, 5)}, 0.5, Arrangement::surface);
  add_wall(scene, BoundaryKind::fixed, {0, 0}, {4, 0});
  for (const Site& site : place_particles(scene)) {
    CHECK(site.soil == (site.position.y() < 2 ? 0 : 1));
    CHECK(std::abs(site.position.y() - 2) > 0.2);
  }
}

TEST_CASE("surface sites keep the soil's area, on slopes too") {
  for (const double spacing : {0.5, 0.4, 0.23}) {
    const Case scene = held_embankment(spacing);
    double area = 0;
    for (const Site& site : place_particles(scene)) {
      area += site.area;
      CHECK(site.fill > 0.24);
      CHECK(site.fill < 1.4);
      CHECK(site.area > 0.24 * spacing * spacing);
    }
    CHECK(area == Approx(Region(embankment()).area()).epsilon(1e-10));
  }
}

TEST_CASE("bands have their middle on free surfaces and where these end") {
  const Case scene = held_embankment(0.2);
  const std::vector<Region> regions = {Region(embankment())};
  const auto has_middle = [&](int axis, double at) {
    return std::ranges::any_of(bands_along(axis, scene, regions, FreeSurfaces::in_the_middle),
                               [&](const Band& band) { return std::abs(band.middle - at) < 1e-9; });
  };
  CHECK(has_middle(1, 6));
  CHECK(has_middle(1, 11));
  for (const double x : {10., 15., 20.5, 33.}) CHECK(has_middle(0, x));
  const std::vector<Band> rows = bands_along(1, scene, regions, FreeSurfaces::in_the_middle);
  CHECK(rows.front().low == Approx(0).margin(1e-12));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    CHECK(rows[i].low == Approx(rows[i - 1].high));
    CHECK(rows[i].high - rows[i].low == Approx(0.2).epsilon(0.05));
  }
}
