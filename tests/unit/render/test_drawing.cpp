// Pictures as files of lines.
#include <catch2/catch.hpp>
#include <regex>

#include "image.hpp"
#include "render/chart.hpp"
#include "render/contour.hpp"
#include "render/drawing.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

ChartFigure figure() {
  Chart chart{.title = "σ'_{yy} with height",
              .x = {.title = "x [m]"},
              .y = {.title = "y"},
              .series = {},
              .references = {}};
  chart.series.push_back({.label = "a line", .x = {0, 1, 2}, .y = {1, 3, 2}, .line = LineStyle::dashed});
  return {.title = "Figure", .charts = {chart}, .width = 500, .height = 300};
}

long count(const std::string& text, const std::string& word) {
  long found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("charts are written as lines, the same bytes each time") {
  for (const char* extension : {"svg", "pdf"}) {
    CAPTURE(extension);
    const auto path = picture_path(std::string("lines.") + extension);
    save_charts(figure(), path);
    const std::string first = contents(path);
    save_charts(figure(), path);
    CHECK(contents(path) == first);
    CHECK(first.size() > 2000);
    CHECK(first.find(extension == std::string("svg") ? "<?xml" : "%PDF-1.") == 0);
  }
  const std::string svg = contents(picture_path("lines.svg"));
  CHECK(std::regex_search(svg, std::regex("<svg [^>]*width=\"500(px)?\" height=\"300(px)?\"")));
  CHECK(svg.find("rgb(0%,44") != std::string::npos);  // the first series' blue
  CHECK(svg.find("<image") == std::string::npos);
}

TEST_CASE("bands become a few regions, particles one each") {
  ContourFigure figure;
  ContourPanel panel;
  panel.particles.sizes = {1};
  SmoothField smooth;
  for (int i = 0; i < 400; ++i) {
    panel.particles.positions.push_back({i % 20 + 0.5, i / 20 + 0.5});
    panel.particles.values.push_back(i / 20);
    if (i % 20 < 19 && i < 380) {
      smooth.triangles.push_back({i, i + 1, i + 21});
      smooth.triangles.push_back({i, i + 21, i + 20});
    }
  }
  smooth.points = panel.particles.positions;
  smooth.values = panel.particles.values;
  smooth.uncovered.assign(400, false);
  panel.smooth = smooth;
  figure.panels = {panel};
  figure.scale = {.label = "v", .range = ValueRange{0, 20}};
  save_contours(figure, picture_path("particles.svg"));
  figure.style = FieldStyle::bands;
  save_contours(figure, picture_path("bands.svg"));
  const std::string particles = contents(picture_path("particles.svg")),
                    bands = contents(picture_path("bands.svg"));
  CHECK(count(particles, "<path") > 400);
  CHECK(count(bands, "<path") < 250);
  CHECK(count(bands, "fill-rule:evenodd") >= 10);
}

TEST_CASE("bands on pixels have the colour of their value, and isolines between") {
  ContourFigure figure;
  ContourPanel panel;
  panel.particles.sizes = {10};
  panel.particles.positions = {{5, 5}};
  panel.particles.values = {5};
  panel.smooth = SmoothField{{{5, 5}, {0, 0}, {10, 0}, {10, 10}, {0, 10}},
                             {5, 0, 0, 10, 10},
                             {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 1, 0}},
                             {false}};
  figure.panels = {panel};
  figure.scale = {.label = "v", .range = ValueRange{0, 10}};
  figure.style = FieldStyle::bands;
  figure.width = 600;
  figure.height = 500;
  save_contours(figure, picture_path("bands.png"));
  const Image image(picture_path("bands.png"));
  FixedScale scale =
      fix_scale({.label = "v", .range = ValueRange{0, 10}, .bands = true}, std::vector<double>{0, 10});
  REQUIRE(scale.levels.size() == 9);
  const std::vector<Colour> colours = band_colours(scale);
  const int bar = image.width() - 108;
  int below = -1;
  for (const Colour& colour : colours) {
    const Patch patch = image.find(colour, bar);
    CHECK(patch.pixels > 1000);
    CHECK(patch.bottom > below);
    below = patch.bottom;
  }
}

TEST_CASE("a film holds its pictures in order, all of one size") {
  const auto figure_of = [](std::size_t i) {
    ContourFigure figure;
    ContourPanel panel;
    panel.title = std::string(i == 1 ? 40 : 3, 'w');
    panel.particles.sizes = {1};
    panel.particles.positions = {{0.5 + static_cast<double>(i), 0.5}, {0.5, 1.5}};
    panel.particles.values = {0, 1};
    figure.panels = {panel};
    figure.scale = {.label = "v", .range = ValueRange{0, 1}};
    figure.include = {{0, 0}, {4, 2}};
    return figure;
  };
  const auto path = picture_path("film.webp");
  save_film(3, figure_of, 5, path);
  const std::string film = contents(path);
  CHECK(film.substr(0, 4) == "RIFF");
  CHECK(film.substr(8, 4) == "WEBP");
  CHECK(count(film, "ANMF") == 3);
  save_film(3, figure_of, 5, path);
  CHECK(contents(path) == film);
}

TEST_CASE("a picture needs a known extension") {
  CHECK_THROWS_WITH(save_charts(figure(), picture_path("chart.jpg")), Catch::Contains(".png, .svg or .pdf"));
  CHECK(is_picture_file("a.pdf"));
  CHECK_FALSE(is_picture_file("a"));
}
