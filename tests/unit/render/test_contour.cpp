#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "image.hpp"
#include "render/contour.hpp"
#include "render/picture.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

constexpr int bar_space = 108;  // at the right of the pictures, where the bar repeats the colours

/// nx x ny particles of size dx from the origin on; values grow with x and y.
ContourPanel block(int nx, int ny, double dx) {
  ContourPanel panel;
  panel.title = "block";
  panel.particles.sizes = {dx};
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      panel.particles.positions.push_back({(i + 0.5) * dx, (j + 0.5) * dx});
      panel.particles.values.push_back(i + 10. * j);
    }
  }
  return panel;
}

ContourFigure figure_of(const ContourPanel& panel) {
  return {.title = "",
          .panels = {panel},
          .scale = {.label = "σ'yy [kPa]", .range = {}},
          .width = 600,
          .height = 700};
}

Colour colour_of(double value, ValueRange range, ColourMap map = ColourMap::viridis) {
  return colours_of(std::vector{value}, {.label = "", .map = map, .range = range})[0];
}

Image saved(const ContourFigure& figure, const std::string& name) {
  save_contours(figure, picture_path(name));
  return Image(picture_path(name));
}

}  // namespace

TEST_CASE("every particle is a square of its size and colour in its place") {
  ContourFigure figure = figure_of(block(2, 2, 1.));
  figure.scale.range = ValueRange{-1, 12};
  const Image image = saved(figure, "four.png");
  REQUIRE(image.width() == 600);
  REQUIRE(image.height() == 700);
  const auto patch = [&](double value) {
    return image.find(colour_of(value, {-1, 12}), image.width() - bar_space);
  };
  const Patch lower_left = patch(0), lower_right = patch(1), upper_left = patch(10), upper_right = patch(11);
  const double side = upper_right.right - lower_left.left + 1;
  for (const Patch& part : {lower_left, lower_right, upper_left, upper_right}) {
    CHECK(part.width() == Approx(side / 2).margin(1.5));
    CHECK(part.height() == Approx(side / 2).margin(1.5));
    CHECK(part.pixels == part.width() * part.height());
  }
  CHECK(std::abs(lower_right.left - lower_left.right) <= 2);
  CHECK(std::abs(upper_left.bottom - lower_left.top) <= 2);
  CHECK(side > 250);
}

TEST_CASE("displacements move particles by their factor") {
  ContourFigure figure = figure_of(block(2, 2, 1.));
  figure.scale.range = ValueRange{-1, 12};
  figure.panels[0].particles.displacements.assign(4, Point(0, 0));
  figure.panels[0].particles.displacements[3] = {0.01, 0.005};
  figure.panels[0].particles.displacement_factor = 100;
  const Image image = saved(figure, "moved.png");
  const Patch still = image.find(colour_of(10, {-1, 12}), image.width() - bar_space);
  const Patch moved = image.find(colour_of(11, {-1, 12}), image.width() - bar_space);
  CHECK(moved.left - still.right == Approx(still.width()).margin(3));
  CHECK(moved.bottom - still.bottom == Approx(0.5 * still.height()).margin(3));
}

TEST_CASE("two runs write the same bytes") {
  const ContourFigure figure = figure_of(block(30, 20, 0.2));
  save_contours(figure, picture_path("first.png"));
  save_contours(figure, picture_path("second.png"));
  CHECK(bytes_of(picture_path("first.png")) == bytes_of(picture_path("second.png")));
}

TEST_CASE("threads may save at once") {
  const ContourFigure figure = figure_of(block(30, 20, 0.2));
  save_contours(figure, picture_path("alone.png"));
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] { save_contours(figure, picture_path(std::to_string(i) + ".png")); });
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < 4; ++i)
    CHECK(bytes_of(picture_path(std::to_string(i) + ".png")) == bytes_of(picture_path("alone.png")));
}

TEST_CASE("many pictures in sequence stay right") {
  ContourFigure figure = figure_of(block(5, 3, 0.2));
  figure.width = 300;
  figure.height = 240;
  save_contours(figure, picture_path("one.png"));
  for (int i = 0; i < 40; ++i) save_contours(figure, picture_path("many.png"));
  CHECK(bytes_of(picture_path("many.png")) == bytes_of(picture_path("one.png")));
}

TEST_CASE("values that are not finite are grey, and the bar says so") {
  ContourFigure figure = figure_of(block(2, 1, 1.));
  figure.panels[0].particles.values = {NAN, 3};
  const Image image = saved(figure, "nan.png");
  const Colour grey = invalid_colour(ColourMap::viridis);
  CHECK(image.find(grey, image.width() - bar_space).width() > 100);
  CHECK(image.find(grey).pixels > image.find(grey, image.width() - bar_space).pixels);

  figure.panels[0].particles.values = {NAN, NAN};
  CHECK_NOTHROW(saved(figure, "all_nan.png"));
}

TEST_CASE("values that are all equal get the middle colour") {
  ContourFigure figure = figure_of(block(2, 1, 1.));
  figure.panels[0].particles.values = {5, 5};
  const Image image = saved(figure, "equal.png");
  CHECK(image.find(colour_of(0.5, {0, 1}), image.width() - bar_space).pixels > 10000);
}

TEST_CASE("panels share one range, and keep their own where they ask for it") {
  ContourFigure figure = figure_of(block(1, 1, 1.));
  figure.panels.push_back(figure.panels[0]);
  figure.panels.push_back(figure.panels[0]);
  figure.panels[1].particles.values = {100};
  figure.panels[2].particles.values = {-7};
  figure.panels[2].own_scale =
      ColourScale{.label = "difference [kPa]", .map = ColourMap::cool_warm, .range = {}};
  figure.width = 1200;
  const Image image = saved(figure, "panels.png");
  CHECK(image.find(colour_of(0, {0, 100})).pixels > 2000);
  CHECK(image.find(colour_of(100, {0, 100})).pixels > 2000);
  CHECK(image.find(colour_of(-7, {-7, 7}, ColourMap::cool_warm)).pixels > 2000);
}

TEST_CASE("water is filled above the soil only") {
  ContourFigure figure = figure_of(block(2, 1, 1.));
  figure.panels[0].scenery.soils = {{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}};
  figure.panels[0].scenery.water = {{-never, never, 2}};
  const Image image = saved(figure, "water.png");
  const Patch water = image.find({222, 236, 250});
  const Patch soil = image.find(colour_of(0, {0, 1}), image.width() - bar_space);
  CHECK(water.width() == Approx(2 * soil.width()).margin(4));
  CHECK(water.height() == Approx(soil.height()).margin(4));
  CHECK(water.bottom >= soil.top);
}

TEST_CASE("particles that have flown far away do not shrink the picture") {
  ContourFigure figure = figure_of(block(2, 1, 1.));
  figure.panels[0].scenery.soils = {{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}};
  figure.panels[0].particles.positions.push_back({1e9, -1e12});
  figure.panels[0].particles.positions.push_back({NAN, 0});
  figure.panels[0].particles.values = {0, 1, 2, 3};
  const Image image = saved(figure, "flown.png");
  CHECK(image.find(colour_of(0, {0, 3}), image.width() - bar_space).width() > 150);
}

TEST_CASE("soil that has run out further than its own size is in the picture") {
  ContourPanel panel = block(200, 2, 0.01);
  for (std::size_t i = 0; i < panel.particles.values.size(); ++i)
    panel.particles.values[i] = panel.particles.positions[i].x() > 1.9 ? 1 : 0;
  panel.scenery.soils = {{{{0, 0}, {0.5, 0}, {0.5, 0.02}, {0, 0.02}}, {}}};
  ContourFigure figure = figure_of(panel);
  figure.scale.range = ValueRange{0, 1};
  const Image image = saved(figure, "runout.png");
  CHECK(image.find(colour_of(1, {0, 1}), image.width() - bar_space).pixels > 0);
}

TEST_CASE("the front of soil that runs out is in the picture, what was thrown off is not") {
  const auto pixels_of_last = [](std::initializer_list<double> front) {
    ContourPanel panel = block(20, 10, 0.1);
    panel.scenery.soils = {{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}};
    for (const double x : front) panel.particles.positions.push_back({x, 0.05});
    panel.particles.values.assign(panel.particles.positions.size(), 0);
    panel.particles.values.back() = 1;
    ContourFigure figure = figure_of(panel);
    figure.scale.range = ValueRange{0, 1};
    const Image image = saved(figure, "front.png");
    return image.find(colour_of(1, {0, 1}), image.width() - bar_space).pixels;
  };
  CHECK(pixels_of_last({2.1, 2.25, 2.4, 2.55, 2.7, 2.85, 3, 3.15, 3.3}) > 0);
  CHECK(pixels_of_last({2.1, 2.25, 2.4, 2.55, 2.7, 2.85, 3, 3.3}) == 0);
}

TEST_CASE("more particles than quads are drawn as points without holes") {
  const ContourPanel panel = [] {
    ContourPanel many = block(1000, 600, 0.01);
    many.particles.values.assign(many.particles.positions.size(), 0.);
    return many;
  }();
  REQUIRE(panel.particles.positions.size() > most_quads);
  ContourFigure figure = figure_of(panel);
  figure.scale.range = ValueRange{0, 1};
  const Image image = saved(figure, "points.png");
  const Patch patch = image.find(colour_of(0, {0, 1}), image.width() - bar_space);
  CHECK(patch.width() > 300);
  CHECK(patch.pixels == static_cast<long>(patch.width()) * patch.height());
  CHECK(static_cast<double>(patch.width()) / patch.height() == Approx(10. / 6).epsilon(0.02));
}

TEST_CASE("arrays that do not fit together are errors that name the panel") {
  ContourFigure figure = figure_of(block(2, 2, 1.));
  const auto path = picture_path("never.png");
  figure.panels[0].particles.values.pop_back();
  CHECK_THROWS_WITH(save_contours(figure, path),
                    Catch::Contains("block") && Catch::Contains("3 values for 4 particles"));
  figure.panels[0] = block(2, 2, 1.);
  figure.panels[0].particles.sizes = {1, 1};
  CHECK_THROWS_WITH(save_contours(figure, path), Catch::Contains("2 sizes"));
  figure.panels[0].particles.sizes = {0};
  CHECK_THROWS_AS(save_contours(figure, path), std::runtime_error);
  figure.panels[0] = ContourPanel{};
  CHECK_THROWS_WITH(save_contours(figure, path), Catch::Contains("no particles"));
  figure.panels.clear();
  CHECK_THROWS_AS(save_contours(figure, path), std::runtime_error);
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("a file that cannot be written is an error that names it") {
  CHECK_THROWS_WITH(save_contours(figure_of(block(2, 2, 1.)), picture_path("no_such_folder/picture.png")),
                    Catch::Contains("no_such_folder"));
}

TEST_CASE("a support that reaches beyond the soil stands beside it") {
  ContourFigure figure = figure_of(block(2, 1, 1.));
  figure.scale.range = ValueRange{-1, 12};
  figure.panels[0].scenery.soils = {{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}};
  const auto soil_pixels = [&] {
    const Image image = saved(figure, "support.png");
    return image.find(colour_of(1, {-1, 12}), image.width() - bar_space).pixels;
  };
  const long bare = soil_pixels();
  figure.panels[0].scenery.boundaries = {{BoundaryKind::roller, {2, 0}, {2, 4}}};
  CHECK(soil_pixels() == bare);
}

TEST_CASE("each panel alone has the range and the place that it has among the others") {
  ContourFigure figure = figure_of(block(1, 1, 1.));
  figure.panels.push_back(figure.panels[0]);
  figure.panels[1].particles.values = {100};
  for (Point& p : figure.panels[1].particles.positions) p.x() += 1;
  const std::vector<std::filesystem::path> paths = {picture_path("left.png"), picture_path("right.png")};
  save_each_panel(figure, 500, paths);
  const Image left = Image(paths[0]), right = Image(paths[1]);
  CHECK(left.width() == 500);
  CHECK(right.width() == 500);
  CHECK(left.height() == right.height());
  const Patch a = left.find(colour_of(0, {0, 100}), 500 - bar_space),
              b = right.find(colour_of(100, {0, 100}), 500 - bar_space);
  CHECK(a.pixels > 1000);
  CHECK(b.left - a.left == Approx(a.width()).margin(2));
  CHECK(b.bottom == a.bottom);
}
