// Every arrangement carries the drawn volume, and which of them a case gets that names none.
#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "solver/case/case_file.hpp"
#include "solver/case/outline_edges.hpp"
#include "solver/case/plausibility.hpp"
#include "solver/geometry/place_particles.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

std::vector<double> carried(const Case& scene) {
  std::vector<double> areas(scene.soils.size());
  for (const Site& site : place_particles(scene)) areas[site.soil] += site.area;
  return areas;
}

const Arrangement all_arrangements[] = {Arrangement::automatic, Arrangement::lattice,
                                        Arrangement::fitted,    Arrangement::disordered,
                                        Arrangement::surface,   Arrangement::stretched};

std::string slope_text(const std::string& particles, const std::string& polygon) {
  return "[particles]\n" + particles + "\n[[soil]]\nname = 'sand'\npolygon = " + polygon +
         "\nyoungs_modulus = 15e6\npoissons_ratio = 0.3\nunit_weight_saturated = 20e3\n"
         "[[boundary]]\nkind = 'fixed'\nfrom = [0, 0]\nto = [10, 0]\n[[boundary]]\nkind = 'roller'\nfrom = "
         "[0, 0]\n"
         "to = [0, 9]\n[[boundary]]\nkind = 'roller'\nfrom = [10, 0]\nto = [10, 9]\n[time]\nend = 1\n";
}

}  // namespace

TEST_CASE("every arrangement carries the drawn volume of every soil") {
  const double spacing = GENERATE(0.7, 0.45, 0.31);
  const auto arrangement = GENERATE(from_range(std::begin(all_arrangements), std::end(all_arrangements)));
  CAPTURE(spacing, static_cast<int>(arrangement));
  Case level = scene_of({rectangle(0, 0, 10, 3.7), rectangle(0, 3.7, 10, 6)}, spacing, arrangement);
  Case slope = scene_of({embankment()}, spacing, arrangement);
  Case hole = scene_of({rectangle(0, 0, 8, 6)}, spacing, arrangement);
  hole.soils[0].holes = {rectangle(3, 2, 4.3, 4.1)};
  for (Case* scene : {&level, &slope, &hole}) {
    scene->particles.disorder = 0.2;
    const std::vector<double> areas = carried(*scene);
    for (std::size_t soil = 0; soil < areas.size(); ++soil)
      CHECK(areas[soil] == Approx(area_of(scene->soils[soil], scene->water).whole).epsilon(1e-9));
  }
}

TEST_CASE("a lattice that fits keeps its cells to the last bit") {
  for (const Site& site : place_particles(scene_of({rectangle(0, 0, 15, 10)}, 0.2)))
    REQUIRE(site.area == 0.2 * 0.2);
}

TEST_CASE("stretched cells are whole between level and upright stretches") {
  const Case scene = scene_of({rectangle(0, 0, 10, 6)}, 0.7, Arrangement::stretched);
  const std::vector<Site> sites = place_particles(scene);
  REQUIRE(sites.size() == 14 * 9);
  for (const Site& site : sites) {
    CHECK(site.area == sites.front().area);
    CHECK(site.fill == 1);
  }
  CHECK(sites.front().position.x() == Approx(5.0 / 14));
  CHECK(sites.front().position.y() == Approx(3.0 / 9));
  CHECK(sites.back().position.y() == Approx(6 - 3.0 / 9));
}

TEST_CASE("stretched rows end where soils meet") {
  Case scene = scene_of({rectangle(0, 0, 4, 3.3), rectangle(0, 3.3, 4, 5)}, 0.5, Arrangement::stretched);
  for (const Site& site : place_particles(scene)) {
    const double height = site.soil == 0 ? 3.3 / 7 : 1.7 / 3, low = site.soil == 0 ? 0 : 3.3;
    const double row = (site.position.y() - low) / height - 0.5;
    CHECK(row == Approx(std::round(row)).margin(1e-9));
  }
}

TEST_CASE("level ground gets rows on its surface, all else stretched cells") {
  Case level = box_of_soil(8, 4);
  hold_as_column(level);
  CHECK(arrangement_for(level) == Arrangement::surface);
  Case layers = level;
  layers.soils.push_back(layers.soils[0]);
  layers.soils[1].polygon = box_outline(0, 2, 4, 3.3);
  layers.boundaries[1].to.y() = layers.boundaries[2].to.y() = 4;
  CHECK(arrangement_for(layers) == Arrangement::surface);
  const Case free_sides = box_of_soil(8, 4);
  CHECK(arrangement_for(free_sides) == Arrangement::stretched);
  Case hole = level;
  hole.soils[0].holes = {box_outline(1, 0.5, 2, 1)};
  CHECK(arrangement_for(hole) == Arrangement::stretched);
  Case slope = level;
  slope.soils[0].polygon[2].y() = 1.5;
  CHECK(arrangement_for(slope) == Arrangement::stretched);
}

TEST_CASE("a case file that names no arrangement says in the end which one it got") {
  const Case level = parse_case(slope_text("spacing = 0.7", "[[0, 0], [10, 0], [10, 6], [0, 6]]"), "a.toml");
  CHECK(level.particles.arrangement == Arrangement::surface);
  CHECK(level.particles.smoothing_ratio == 1);
  const Case slope = parse_case(slope_text("spacing = 0.7", "[[0, 0], [10, 0], [10, 3], [0, 6]]"), "a.toml");
  CHECK(slope.particles.arrangement == Arrangement::stretched);
  CHECK(slope.particles.smoothing_ratio == 1);
  const Case lattice = parse_case(
      slope_text("spacing = 0.7\narrangement = 'lattice'", "[[0, 0], [10, 0], [10, 6], [0, 6]]"), "a.toml");
  CHECK(lattice.particles.arrangement == Arrangement::lattice);
  CHECK(lattice.particles.smoothing_ratio == 1.2);
  CHECK_THAT(write_case(slope), Catch::Contains("arrangement = \"stretched\""));
}
