#include "solver/water/flow/outline.hpp"

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace porosph;
using namespace porosph::test;

namespace {

double length_of(const HydraulicOutline& outline, int face) {
  double sum = 0;
  for (const HydraulicPatch& p : outline.patches)
    if (p.face == face) sum += p.to - p.from;
  return sum;
}

}  // namespace

TEST_CASE("soils side by side have one outline, without what is between them", "[water]") {
  Case scene = seepage_box(2, 1, 0.1);
  SoilCase above = scene.soils[0];
  above.name = "above";
  above.polygon = {{0, 1}, {1, 1}, {1, 2}, {0, 2}};
  scene.soils.push_back(above);
  scene.water.faces.clear();
  const HydraulicOutline outline = hydraulic_outline(scene.soils, scene.water.faces, 0.1);
  CHECK(outline.stretches.size() == 6);  // the left side of both is one
  double whole = 0;
  for (const Wall& w : outline.stretches) {
    whole += (w.to - w.from).norm();
    CHECK(w.distance({0.5, 0.5}) > 0);
  }
  CHECK(whole == Approx(8));
}

TEST_CASE("of faces that overlap the later one holds", "[water]") {
  Case scene = seepage_box(2, 1, 0.1);
  scene.water.faces = {{}, head_face({-1, 1}, {5, 1}, 1), head_face({0.5, 1}, {1.25, 1}, 2)};
  const HydraulicOutline outline = hydraulic_outline(scene.soils, scene.water.faces, 0.1);
  CHECK(length_of(outline, 0) == Approx(4));
  CHECK(length_of(outline, 1) == Approx(1.25));
  CHECK(length_of(outline, 2) == Approx(0.75));
  CHECK(unnamed_stretch(outline).empty());
}

TEST_CASE("what no face names is reported", "[water]") {
  Case scene = seepage_box(2, 1, 0.1);
  scene.water.faces = {head_face({0, 0}, {0, 1}, 1), head_face({0, 0}, {2, 0}, 1),
                       head_face({2, 0}, {2, 1}, 1), head_face({0, 1}, {1.5, 1}, 1)};
  const HydraulicOutline outline = hydraulic_outline(scene.soils, scene.water.faces, 0.1);
  CHECK(unnamed_stretch(outline) == "(2, 1) to (1.5, 1)");
  CHECK(touches(scene.water.faces[0], scene.soils, 0.1));
  CHECK_FALSE(touches(head_face({0, 1.1}, {1, 1.1}, 1), scene.soils, 0.1));
}
