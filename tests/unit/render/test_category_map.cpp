#include <catch2/catch.hpp>

#include "render/category_map.hpp"
#include "tests/unit/render/image.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

const Colour green{0, 158, 115}, red{213, 94, 0};

CategoryMap example() {
  return {.title = "Courant number and damping",
          .x = {"C", {"0.2", "0.9"}, {true, false}},
          .y = {"xi", {"0", "0.1"}, {}},
          .categories = {{"good", green}, {"bad", red}},
          .cells = {{0, "0.5 %", ""}, {0, "0.5 %", ""}, {1, "0.1 s", "too fast"}, {-1, "", ""}},
          .notes = {"A note."},
          .mark_label = "usual"};
}

}  // namespace

TEST_CASE("a map of outcomes has its cells in their colours and places", "[render]") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "porosph_category_map.png";
  save_category_map(example(), file);
  const Image image(file);
  const Patch good = image.find(green, image.width()), bad = image.find(red, image.width());
  REQUIRE(good.pixels > 1000);
  REQUIRE(bad.pixels > 1000);
  CHECK(good.pixels > bad.pixels);  // two cells against one
  CHECK(bad.top > good.top);        // the upper row
  std::filesystem::remove(file);
}

TEST_CASE("a map whose cells do not fit its axes is refused", "[render]") {
  CategoryMap map = example();
  map.cells.pop_back();
  CHECK_THROWS_AS(save_category_map(map, "map.png"), std::runtime_error);
}
