#include <catch2/catch.hpp>

#include "render/run/water_around.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

Case dam() {
  Case scene;
  SoilCase soil;
  soil.polygon = {{0, 0}, {58, 0}, {34, 12}, {30, 12}};
  scene.soils = {soil};
  scene.particles.spacing = 0.5;
  scene.water.mode = WaterMode::steady;
  return scene;
}

}  // namespace

TEST_CASE("water stands beside a slope up to its level, and not below a base") {
  Case scene = dam();
  scene.water.faces = {{},
                       {.kind = FaceKind::head, .from = {0, 0}, .to = {30, 12}, .level = 10},
                       {.kind = FaceKind::head, .from = {46, 0}, .to = {58, 0}, .level = 3},
                       {.kind = FaceKind::seepage, .from = {34, 12}, .to = {58, 0}}};
  const std::vector<WaterStretch> water = water_beside_faces(scene);
  REQUIRE(water.size() == 1);
  CHECK(water[0].level == 10);
  CHECK(water[0].x_from == -never);
  CHECK(water[0].x_to == Approx(25));
}

TEST_CASE("the water table runs where the pressure head changes its sign") {
  const double level = GENERATE(1.3, 2.0);
  std::vector<Point> positions;
  std::vector<double> psi;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row < 8; ++row) {
      if (column == 3) continue;  // a gap
      positions.emplace_back(0.25 + 0.5 * column, 0.25 + 0.5 * row);
      psi.push_back(level + 0.1 * column - positions.back().y());
    }
  const auto lines = water_table(positions, psi, 0.5);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].size() == 3);
  CHECK(lines[1].size() == 2);
  for (const auto& line : lines)
    for (const Point& p : line) CHECK(p.y() == Approx(level + 0.1 * (p.x() - 0.25) / 0.5));
}
