#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "render/chart_range.hpp"
#include "render/contour_layout.hpp"
#include "render/legend.hpp"
#include "render/scenery.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

ContourSpace space_of(double width, double height, std::vector<bool> own_scale) {
  ContourSpace space;
  space.world_width = width;
  space.world_height = height;
  space.margins = {60, 50, 6, 40};
  space.padding = 18;
  space.bar_slot = 90;
  space.own_scale = std::move(own_scale);
  return space;
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.top() && b.y < a.top();
}

}  // namespace

TEST_CASE("panels and bars lie within the picture and apart") {
  for (const auto& [width, height] : {std::pair{15., 15.}, {44.4, 11.}, {1., 10.}}) {
    for (const auto& own :
         {std::vector{false}, {false, false}, {false, false, true}, {true, true, false, false}}) {
      const ContourLayout layout = lay_out(space_of(width, height, own), {});
      std::vector<Box> boxes = layout.frames;
      for (const BarPlace& bar : layout.bars) boxes.push_back(bar.box);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        CHECK(boxes[i].x >= 0);
        CHECK(boxes[i].y >= 0);
        CHECK(boxes[i].right() <= layout.width);
        CHECK(boxes[i].top() <= layout.height);
        for (std::size_t k = 0; k < i; ++k) CHECK_FALSE(overlap(boxes[i], boxes[k]));
      }
    }
  }
}

TEST_CASE("wide bodies are stacked under one bar, tall ones stand side by side") {
  const ContourLayout wide = lay_out(space_of(44.4, 11, {false, false}), {});
  CHECK(wide.frames[0].x == wide.frames[1].x);
  REQUIRE(wide.bars.size() == 1);
  CHECK(wide.bars[0].box.y == wide.frames[1].y);
  CHECK(wide.bars[0].box.top() == wide.frames[0].top());
  const ContourLayout tall = lay_out(space_of(1, 10, {false, false}), {});
  CHECK(tall.frames[0].y == tall.frames[1].y);
  CHECK(tall.bars.size() == 1);
}

TEST_CASE("a last row that is not full has no bar of its own, and no column is kept for one") {
  ContourSize size;
  size.columns = 3;
  const ContourLayout layout = lay_out(space_of(15, 15, std::vector<bool>(5, false)), size);
  CHECK(layout.bars.size() == 1);
  CHECK(layout.frames[1].x - layout.frames[0].right() == layout.frames[2].x - layout.frames[1].right());
}

TEST_CASE("a panel with its own scale has its own bar") {
  const ContourLayout layout = lay_out(space_of(44.4, 11, {false, false, true}), {});
  REQUIRE(layout.bars.size() == 2);
  CHECK(layout.bars[1].panel == 2);
  CHECK(layout.bars[1].box.height == layout.frames[2].height);
}

TEST_CASE("the size that was asked for is kept, and one too small is an error") {
  const ContourLayout layout = lay_out(space_of(15, 10, {false}), {.width = 800, .height = 500});
  CHECK(layout.width == 800);
  CHECK(layout.height == 500);
  CHECK_THROWS_WITH((lay_out(space_of(15, 10, {false}), {.width = 150, .height = 100})),
                    Catch::Contains("150 x 100"));
}

TEST_CASE("a horizontal line is cut by slopes and holes") {
  const std::vector<SoilOutline> soils = {
      {{{0, 0}, {10, 0}, {10, 2}, {6, 6}, {4, 6}, {0, 2}}, {{{4, 1}, {6, 1}, {6, 5}, {4, 5}}}}};
  const auto inside = soil_intervals(soils, 4, -5, 20);
  REQUIRE(inside.size() == 2);
  CHECK(inside[0].from == Approx(2));
  CHECK(inside[0].to == Approx(4));
  CHECK(inside[1].to == Approx(8));
  const auto open = free_intervals(soils, 4, -5, 20);
  REQUIRE(open.size() == 3);
  CHECK(open[0].from == -5);
  CHECK(open[1].length() == Approx(2));
  CHECK(open[2].to == 20);
}

TEST_CASE("the legend finds a corner without lines, if there is one") {
  const Box frame{0, 0, 400, 300};
  const std::vector<std::vector<Pixel>> rising = {{{0, 0}, {400, 300}}};
  const auto corner = free_corner(frame, {100, 60}, rising);
  REQUIRE(corner);
  CHECK(corner->right() <= 400);
  const bool lower_right = corner->x > 200 && corner->top() < 150,
             upper_left = corner->x < 200 && corner->y > 150;
  CHECK((lower_right || upper_left));
  const std::vector<std::vector<Pixel>> everywhere = {{{0, 0}, {400, 300}}, {{0, 300}, {400, 0}}};
  CHECK_FALSE(free_corner(frame, {100, 60}, everywhere));
  CHECK_FALSE(free_corner(frame, {390, 60}, {}).has_value());
}

TEST_CASE("dashes cover their share of a line, around corners too") {
  const std::vector<Pixel> line = {{0, 0}, {30, 0}, {30, 30}};
  double drawn = 0;
  for (const auto& part : dashed(line, std::vector<double>{6, 4}))
    for (std::size_t i = 0; i + 1 < part.size(); ++i)
      drawn += std::hypot(part[i + 1].x - part[i].x, part[i + 1].y - part[i].y);
  CHECK(drawn == Approx(36));
}

TEST_CASE("chart axes hold the data and the reference lines") {
  Chart chart;
  chart.series = {{.label = "", .x = {0, 1, 3.999}, .y = {0, -40, NAN}}};
  chart.references = {{"theory", -50}};
  CHECK(x_axis_of(chart).low == 0);
  CHECK(x_axis_of(chart).high == Approx(4));
  CHECK(y_axis_of(chart).low < -50);
  CHECK(y_axis_of(chart).high > 0);
}

TEST_CASE("logarithmic axes leave out what they cannot show") {
  Chart chart;
  chart.y.logarithmic = true;
  chart.series = {{.label = "", .x = {0, 1, 2}, .y = {0, 1e-3, 10}}};
  const Axis axis = y_axis_of(chart);
  CHECK(axis.low > 1e-4);
  CHECK(axis.low < 1e-3);
  CHECK(axis.fraction(std::sqrt(axis.low * axis.high)) == Approx(0.5));
  chart.y.title = "error [-]";
  chart.y.range = ValueRange{0, 1};
  CHECK_THROWS_WITH(y_axis_of(chart), Catch::Contains("error [-]") && Catch::Contains("logarithmic"));
}
