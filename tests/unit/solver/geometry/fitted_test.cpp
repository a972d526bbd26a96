#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/geometry/place_particles.hpp"
#include "solver/geometry/region.hpp"
#include "tests/unit/solver/geometry/scenes.hpp"

using namespace porosph;

namespace {

/// A star with holes: concave, no edge along the lattice.
Case star_scene(double spacing, Arrangement arrangement) {
  Polygon star, hole;
  for (int k = 0; k < 14; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.137) / 14, radius = k % 2 ? 1.1 : 2.7;
    star.push_back(Point(0.3, -0.2) + radius * Point(std::cos(angle), std::sin(angle)));
    if (k % 2) hole.push_back(star.front() * 0.1 + 0.3 * Point(std::cos(angle), std::sin(angle)));
  }
  Case scene = scene_of({star}, spacing, arrangement);
  scene.soils[0].holes = {hole};
  return scene;
}

double total_area(const std::vector<Site>& sites) {
  double sum = 0;
  for (const Site& site : sites) sum += site.area;
  return sum;
}

Point centroid(const std::vector<Site>& sites) {
  Point sum = Point::Zero();
  for (const Site& site : sites) sum += site.area * site.position;
  return sum / total_area(sites);
}

}  // namespace

TEST_CASE("fitted sites keep area and centroid of the soil") {
  for (const double spacing : {0.5, 0.2, 0.0731}) {
    for (const Case& scene :
         {scene_of({embankment()}, spacing, Arrangement::fitted), star_scene(spacing, Arrangement::fitted)}) {
      const Region region(scene.soils[0].polygon, scene.soils[0].holes);
      const std::vector<Site> sites = place_particles(scene);
      CHECK(total_area(sites) == Approx(region.area()).epsilon(1e-10));
      CHECK((centroid(sites) - region.centroid()).norm() < 1e-10 * region.size());
      const auto [least, most] = std::ranges::minmax(sites, {}, &Site::area);
      CHECK(least.area >= 0.35 * spacing * spacing);
      CHECK(most.area < 1.8 * spacing * spacing);
    }
  }
}

TEST_CASE("fitted sites are the lattice where the outline follows it") {
  const Polygon step = {{0, 0}, {6, 0}, {6, 2}, {3, 2}, {3, 4.2}, {0, 4.2}};
  const std::vector<Site> fitted = place_particles(scene_of({step}, 0.2, Arrangement::fitted));
  const std::vector<Site> lattice = place_particles(scene_of({step}, 0.2));
  REQUIRE(fitted.size() == lattice.size());
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    REQUIRE(fitted[i].position == lattice[i].position);
    REQUIRE(fitted[i].area == lattice[i].area);
  }
}

TEST_CASE("a slope through the cells' corners leaves half cells with their centroids") {
  const std::vector<Site> sites =
      place_particles(scene_of({{{0, 0}, {3, 0}, {0, 3}}}, 1, Arrangement::fitted));
  REQUIRE(sites.size() == 6);
  CHECK(sites[0].area == 1);
  CHECK(sites[2].area == Approx(0.5));
  CHECK(sites[2].position.x() == Approx(2 + 1.0 / 3));
  CHECK(sites[2].position.y() == Approx(1.0 / 3));
}

TEST_CASE("slivers join the neighbour below or beside") {
  const std::vector<Site> sites =
      place_particles(scene_of({rectangle(0, 0, 2.1, 1.2)}, 1, Arrangement::fitted));
  REQUIRE(sites.size() == 2);
  CHECK(sites[0].position.isApprox(Point(0.5, 0.6)));
  CHECK(sites[0].area == Approx(1.2));
  CHECK(sites[1].position.isApprox(Point(1.55, 0.6)));
  CHECK(sites[1].area == Approx(1.1 * 1.2));
}

TEST_CASE("no site carries soil from both sides of a wall or slit thinner than a cell") {
  const double left = GENERATE(1.9, 2.03, 2.11, 2.24), lean = GENERATE(0.0, 0.4, 1.5);
  const double thickness = GENERATE(0.01, 0.05, 0.2);
  const Point foot(left, 1), head(left + lean, 3), across(thickness, 0);
  const Region region({{0, 0}, {4, 0}, {4, 3}, head + across, foot + across, foot, head, {0, 3}});
  CAPTURE(left, lean, thickness);
  for (const Arrangement arrangement : {Arrangement::fitted, Arrangement::surface, Arrangement::stretched}) {
    const std::vector<Site> sites = place_particles(scene_of({region.rings()[0]}, 0.25, arrangement));
    CHECK(total_area(sites) == Approx(region.area()).epsilon(1e-10));
    for (const Site& site : sites) CHECK(region.contains(site.position));
    if (arrangement != Arrangement::fitted) continue;
    CHECK((centroid(sites) - region.centroid()).norm() < 1e-10 * region.size());
    CHECK(std::ranges::min(sites, {}, &Site::area).area > 0.3 * 0.25 * 0.25);
  }
}

TEST_CASE("soils that share a border are fitted to it from both sides") {
  const std::vector<Site> sites = place_particles(
      scene_of({{{0, 0}, {4, 0}, {4, 1.13}, {0, 2.37}}, {{0, 2.37}, {4, 1.13}, {4, 4}, {0, 4}}}, 0.25,
               Arrangement::fitted));
  double lower = 0;
  for (const Site& site : sites)
    if (site.soil == 0) lower += site.area;
  CHECK(lower == Approx(4 * (1.13 + 2.37) / 2).epsilon(1e-10));
  CHECK(total_area(sites) == Approx(16).epsilon(1e-10));
}

TEST_CASE("a soil smaller than a cell is one particle") {
  const std::vector<Site> sites =
      place_particles(scene_of({rectangle(0, 0, 0.3, 0.2)}, 1, Arrangement::fitted));
  REQUIRE(sites.size() == 1);
  CHECK(sites[0].area == Approx(0.06));
  CHECK(sites[0].position.isApprox(Point(0.15, 0.1)));
}

TEST_CASE("Voronoi areas of disordered sites sum up to the soil's") {
  for (const double disorder : {0.0, 0.2, 0.5}) {
    Case star = star_scene(0.0731, Arrangement::disordered);
    Case slope = scene_of({embankment()}, 0.2, Arrangement::disordered);
    for (Case* scene : {&star, &slope}) {
      scene->particles.disorder = disorder;
      const Region region(scene->soils[0].polygon, scene->soils[0].holes);
      const std::vector<Site> sites = place_particles(*scene);
      CHECK(total_area(sites) == Approx(region.area()).epsilon(1e-10));
      for (const Site& site : sites) {
        REQUIRE(region.contains(site.position));
        REQUIRE(site.area > 0);
      }
    }
  }
}

TEST_CASE("disordered sites are displaced by up to the disorder, the same for the same seed") {
  Case scene = scene_of({rectangle(0, 0, 5, 4)}, 0.1, Arrangement::disordered);
  scene.particles.disorder = 0.3;
  const std::vector<Site> sites = place_particles(scene), again = place_particles(scene);
  scene.particles.seed = 2;
  const std::vector<Site> others = place_particles(scene);
  const std::vector<Site> lattice = place_particles(scene_of({rectangle(0, 0, 5, 4)}, 0.1));
  REQUIRE(sites.size() == lattice.size());
  double largest = 0, sum = 0, square = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Point displacement = (sites[i].position - lattice[i].position) / 0.1;
    largest = std::max(largest, displacement.lpNorm<Eigen::Infinity>());
    sum += displacement.x();
    square += displacement.x() * displacement.x();
    REQUIRE(sites[i].position == again[i].position);
    REQUIRE(sites[i].area == again[i].area);
  }
  CHECK(largest < 0.3);
  CHECK(largest > 0.29);
  CHECK(sum / 2000 == Approx(0).margin(0.02));
  CHECK(square / 2000 == Approx(0.09 / 3).epsilon(0.05));  // variance of the uniform distribution
  CHECK(sites[0].position != others[0].position);
}

TEST_CASE("the Voronoi cells of undisturbed sites are the lattice's") {
  Case scene = scene_of({rectangle(0, 0, 3, 2)}, 0.25, Arrangement::disordered);
  for (const Site& site : place_particles(scene)) CHECK(site.area == Approx(0.0625).epsilon(1e-12));
}
