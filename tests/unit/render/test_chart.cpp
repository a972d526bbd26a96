#include <catch2/catch.hpp>
#include <cmath>

#include "image.hpp"
#include "render/chart.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

Chart flat(double y) {
  Chart chart;
  chart.x = {.title = "t [s]", .range = {}};
  chart.y = {.title = "v [m/s]", .range = ValueRange{0, 1}};
  chart.series = {{.label = "", .x = {0, 1}, .y = {y, y}, .width = 4}};
  return chart;
}

Image saved(const ChartFigure& figure, const std::string& name) {
  save_charts(figure, picture_path(name));
  return Image(picture_path(name));
}

}  // namespace

TEST_CASE("a line is at its value's height, in its colour, across the chart") {
  const Colour blue = series_colour(0);
  const Patch quarter = saved({.title = "", .charts = {flat(0.25)}}, "quarter.png").find(blue);
  const Patch half = saved({.title = "", .charts = {flat(0.5)}}, "half.png").find(blue);
  const Patch three = saved({.title = "", .charts = {flat(0.75)}}, "three.png").find(blue);
  CHECK(quarter.width() > 600);
  CHECK(quarter.height() <= 5);
  CHECK(half.bottom - quarter.bottom > 60);
  CHECK(three.bottom - half.bottom == Approx(half.bottom - quarter.bottom).margin(1));
}

TEST_CASE("on a logarithmic axis equal factors are equal distances") {
  const auto height = [](double y, const std::string& name) {
    Chart chart = flat(y);
    chart.y.logarithmic = true;
    chart.y.range = ValueRange{1e-4, 1};
    return saved({.title = "", .charts = {chart}}, name).find(series_colour(0)).bottom;
  };
  const int low = height(1e-3, "low.png"), middle = height(1e-2, "middle.png"),
            high = height(1e-1, "high.png");
  CHECK(middle - low > 40);
  CHECK(high - middle == Approx(middle - low).margin(1));
}

TEST_CASE("nothing is drawn beyond a given range") {
  const Patch outside = saved({.title = "", .charts = {flat(1.5)}}, "outside.png").find(series_colour(0));
  CHECK(outside.pixels == 0);
}

TEST_CASE("upright lines stand where their x is, and names without room are left out") {
  const Colour grey{110, 110, 110};
  const auto drawn = [&](std::vector<UprightLine> uprights, const std::string& name) {
    Chart chart = flat(0.5);
    chart.uprights = std::move(uprights);
    return saved({.title = "", .charts = {chart}}, name).find(grey);
  };
  CHECK(drawn({{"", 2}}, "upright_beyond.png").pixels == 0);
  const Patch one = drawn({{"", 0.5}}, "upright.png"), two = drawn({{"", 0.25}, {"", 0.75}}, "uprights.png");
  CHECK(one.height() > 250);
  CHECK(one.width() <= 2);
  CHECK(0.5 * (two.left + two.right) == Approx(0.5 * (one.left + one.right)).margin(1));
  const auto bytes = [&](std::vector<UprightLine> uprights) {
    drawn(std::move(uprights), "uprights_named.png");
    return bytes_of(picture_path("uprights_named.png"));
  };
  CHECK(bytes({{"dig", 0.5}}) != bytes({{"", 0.5}}));
  CHECK(bytes({{"dig", 0.999}}) == bytes({{"", 0.999}}));
  CHECK(bytes({{"dig", 0.5}, {"", 0.51}}) == bytes({{"", 0.5}, {"", 0.51}}));
}

TEST_CASE("values that are not finite interrupt a line") {
  Chart chart = flat(0.5);
  chart.series[0].x = {0, 1, 2, 3, 4};
  chart.series[0].y = {0.5, 0.5, NAN, 0.5, 0.5};
  const Patch all = saved({.title = "", .charts = {flat(0.5)}}, "whole.png").find(series_colour(0));
  const Patch parts = saved({.title = "", .charts = {chart}}, "parts.png").find(series_colour(0));
  CHECK(static_cast<double>(parts.pixels) == Approx(0.5 * static_cast<double>(all.pixels)).epsilon(0.03));
}

TEST_CASE("a chart without any finite value is drawn empty") {
  Chart chart = flat(NAN);
  chart.y.range.reset();
  const Image image = saved({.title = "", .charts = {chart}}, "empty.png");
  CHECK(image.find(series_colour(0)).pixels == 0);
  CHECK(image.find(white).pixels < image.width() * image.height());
}

TEST_CASE("a legend without a free corner stands right of the frame") {
  Chart chart = flat(0.5);
  chart.series[0].width = 2;
  chart.series[0].x.clear();
  chart.series[0].y.clear();
  for (int i = 0; i <= 400; ++i) {
    chart.series[0].x.push_back(i / 400.);
    chart.series[0].y.push_back(i % 2);
  }
  const Patch without = saved({.title = "", .charts = {chart}}, "without.png").find(series_colour(0));
  chart.series[0].label = "vibration";
  const Image image = saved({.title = "", .charts = {chart}}, "with.png");
  const Patch with = image.find(series_colour(0), image.width() - 130);
  CHECK(without.right > image.width() - 60);
  CHECK(with.right < image.width() - 130);
}

TEST_CASE("charts are laid out in columns, and saved alike each time") {
  const ChartFigure figure{.title = "Histories", .charts = {flat(0.2), flat(0.4), flat(0.6)}, .columns = 2};
  const Image image = saved(figure, "a.png");
  CHECK(image.width() == 2 * 760);
  CHECK(image.height() > 2 * 400);
  save_charts(figure, picture_path("b.png"));
  CHECK(bytes_of(picture_path("a.png")) == bytes_of(picture_path("b.png")));
  const ChartFigure small{.title = "", .charts = {flat(0.2)}, .width = 400, .height = 300};
  CHECK(saved(small, "small.png").width() == 400);
}

TEST_CASE("wrong charts are errors that name them") {
  Chart chart = flat(0.5);
  chart.title = "Point A";
  chart.series[0].y.pop_back();
  const auto path = picture_path("never_chart.png");
  CHECK_THROWS_WITH((save_charts({.title = "", .charts = {chart}}, path)),
                    Catch::Contains("Point A") && Catch::Contains("2 x for 1 y"));
  CHECK_THROWS_AS(save_charts({}, path), std::runtime_error);
  CHECK_THROWS_WITH((save_charts({.title = "", .charts = {flat(0.5)}, .width = 100, .height = 50}, path)),
                    Catch::Contains("larger"));
  CHECK_THROWS_WITH((save_charts({.title = "", .charts = {flat(0.5)}, .width = 9000, .height = 500}, path)),
                    Catch::Contains("9000 x 500"));
}
