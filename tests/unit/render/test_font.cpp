#include <catch2/catch.hpp>
#include <cstdlib>

#include "render/canvas.hpp"
#include "render/font.hpp"

using namespace porosph;
using namespace porosph::render;

TEST_CASE("a missing font is an error that says what to install") {
  CHECK_THROWS_WITH((find_font("DejaVuSans.ttf", {"/no/such/folder", "/nor/this"})),
                    Catch::Contains("DejaVuSans.ttf") && Catch::Contains("/no/such/folder, /nor/this") &&
                        Catch::Contains("fonts-dejavu-core"));
}

TEST_CASE("the font can be chosen, but has to exist") {
  setenv("POROSPH_FONT", "/no/such/font.ttf", 1);
  CHECK_THROWS_WITH(font_file(), Catch::Contains("/no/such/font.ttf"));
  unsetenv("POROSPH_FONT");
  CHECK_NOTHROW(font_file());
}

TEST_CASE("Greek letters and signs have a width of their own") {
  for (const char* text : {"σ", "γ", "−", "×", "⁻", "⁵"}) CHECK(text_extent(text, 20).x > 3);
  CHECK(text_extent("σ'yy [kPa]", 20).x == Approx(2 * text_extent("σ'yy [kPa]", 10).x).epsilon(0.03));
}

TEST_CASE("a text that is too long is made smaller until it fits") {
  const std::string text = "a title that is far too long for its panel";
  const double size = fitting_size(text, 15, 120);
  CHECK(size < 15);
  CHECK(text_extent(text, size).x <= 120);
  CHECK(fitting_size("short", 15, 120) == 15);
}

TEST_CASE("subscripts take the room of smaller letters, without their signs") {
  CHECK(text_extent("u_{y}", 20).x < text_extent("uy", 20).x + 2);
  CHECK(text_extent("u_{y}", 20).x > text_extent("u", 20).x + 4);
  CHECK(text_extent("my_slope", 20).x > text_extent("myslope", 20).x);  // a name keeps its underscore
  CHECK(text_extent("a_{b", 20).x > text_extent("ab", 20).x + 10);
}
