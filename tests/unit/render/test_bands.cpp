// Bands, isolines and triangles under them, against areas and lines that are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "render/bands.hpp"
#include "render/canvas_device.hpp"
#include "render/field_marks.hpp"
#include "render/run/delaunay.hpp"
#include "render/run/soil_mesh.hpp"
#include "solver/case/shapes.hpp"
#include "solver/geometry/place_particles.hpp"

using namespace porosph;
using namespace porosph::render;

namespace {

double area_of(std::span<const Pixel> ring) {
  double doubled = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Pixel &a = ring[i], &b = ring[(i + 1) % ring.size()];
    doubled += a.x * b.y - b.x * a.y;
  }
  return 0.5 * std::abs(doubled);
}

/// A square of 10 x 10 in triangles, with values of a function.
template <class Value>
TriangleField square(int cells, Value value) {
  TriangleField field;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      field.points.push_back({10. * i / cells, 10. * j / cells});
      field.values.push_back(value(field.points.back()));
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      field.triangles.push_back({a, b, d});
      field.triangles.push_back({a, d, c});
    }
  return field;
}

/// Remembers where texts are put.
class TextsOnly : public CanvasDevice {
 public:
  std::vector<Pixel> texts;
  void polyline(std::span<const Pixel>, Colour, double) override {}
  void polygon(std::span<const Pixel>, const Fill&) override {}
  void text(Pixel at, const std::string&, const TextStyle&) override { texts.push_back(at); }
  void clip(const Box&) override {}
  void unclip() override {}
};

double linear(Pixel p) { return 2 * p.x - p.y; }
double radius(Pixel p) { return std::hypot(p.x - 5, p.y - 5); }

double doubled_area(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

TEST_CASE("bands fill the field, each with its share") {
  const std::vector<double> levels = {-5, 0, 4.3, 12};
  const TriangleField field = square(7, linear);
  std::vector<double> areas(levels.size() + 1);
  for (const BandPiece& piece : band_pieces(field, levels))
    areas[static_cast<std::size_t>(piece.band)] +=
        area_of({piece.corners.data(), static_cast<std::size_t>(piece.count)});
  const auto below = [](double level) {  // area where 2x - y < level, by integrating over y
    double area = 0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i)
      area += std::clamp(0.5 * (level + 10. * (i + 0.5) / steps), 0., 10.) * 10 / steps;
    return area;
  };
  double before = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    CHECK(areas[i] == Approx(below(levels[i]) - before).margin(1e-6));
    before = below(levels[i]);
    double above = 0;
    for (const auto& ring : region_above(field, levels[i])) above += area_of(ring);
    CHECK(above == Approx(100 - before).margin(1e-6));
  }
  CHECK(areas.back() == Approx(100 - before).margin(1e-6));
}

TEST_CASE("isolines are whole, open or closed") {
  const auto straight = isolines(square(7, linear), 4.3);
  REQUIRE(straight.size() == 1);
  for (const Pixel& p : straight[0]) CHECK(linear(p) == Approx(4.3));
  CHECK(std::hypot(straight[0].back().x - straight[0].front().x,
                   straight[0].back().y - straight[0].front().y) == Approx(std::hypot(5, 10)));
  const auto circle = isolines(square(80, radius), 3);
  REQUIRE(circle.size() == 1);
  CHECK(circle[0].front().x == circle[0].back().x);
  CHECK(circle[0].front().y == circle[0].back().y);
  CHECK(area_of(circle[0]) == Approx(M_PI * 9).epsilon(0.002));
  CHECK(isolines(square(7, linear), 99).empty());
}

TEST_CASE("a level that runs through points of the field cuts it cleanly") {
  const TriangleField field = square(10, linear);
  const auto lines = isolines(field, 0);
  REQUIRE(lines.size() == 1);
  double above = 0;
  for (const auto& ring : region_above(field, 0)) above += area_of(ring);
  CHECK(above == Approx(75));
}

TEST_CASE("triangles with a corner without value are left out") {
  TriangleField field = square(10, linear);
  field.values[60] = NAN;  // the middle: six triangles of half a unit
  double area = 0, outline = 0;
  for (const BandPiece& piece : band_pieces(field, std::vector{3.}))
    area += area_of({piece.corners.data(), static_cast<std::size_t>(piece.count)});
  CHECK(area == Approx(97));
  const auto rings = region_above(field, -1e9);
  REQUIRE(rings.size() == 2);
  for (const auto& ring : rings) outline += area_of(ring);
  CHECK(outline == Approx(103));  // the square, and its hole
}

TEST_CASE("triangles fill the hull of points, and no point lies in the circle of another's triangle") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  std::vector<Point> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 200; ++i) points.push_back({place(random), place(random)});
  double area = 0;
  int violations = 0;
  for (const auto& t : delaunay(points)) {
    const Point &a = points[static_cast<std::size_t>(t[0])], &b = points[static_cast<std::size_t>(t[1])],
                &c = points[static_cast<std::size_t>(t[2])];
    area += 0.5 * doubled_area(a, b, c);
    for (const Point& p : points) {
      Eigen::Matrix3d in;
      for (int i = 0; i < 3; ++i) {
        const Point d = points[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])] - p;
        in.row(i) << d.x(), d.y(), d.squaredNorm();
      }
      violations += in.determinant() > 1e-9;
    }
  }
  CHECK(area == Approx(1));
  CHECK(violations == 0);
}

TEST_CASE("a lattice is triangulated without gaps") {
  std::vector<Point> points;
  for (int i = 0; i < 100; ++i) points.push_back({0.3 * (i % 10), 1e6 + 0.3 * (i / 10)});
  double area = 0;
  const auto triangles = delaunay(points);
  for (const auto& t : triangles)
    area += 0.5 * doubled_area(points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
                               points[static_cast<std::size_t>(t[2])]);
  CHECK(triangles.size() == 2 * 81);
  CHECK(area == Approx(2.7 * 2.7).epsilon(1e-6));
}

namespace {

/// A slope with a hole, on a layer of another soil.
Case layered_slope(Arrangement arrangement, double spacing) {
  Case scene;
  scene.soils.resize(2);
  scene.soils[0].name = "sand";
  scene.soils[0].polygon = {{0, 1}, {6, 1}, {6, 2}, {5, 2}, {2, 4}, {0, 4}};
  scene.soils[0].holes = {{{0.8, 1.8}, {1.6, 1.8}, {1.6, 2.6}, {0.8, 2.6}}};
  scene.soils[1].name = "clay";
  scene.soils[1].polygon = {{0, 0}, {6, 0}, {6, 1}, {0, 1}};
  scene.boundaries = {{BoundaryKind::fixed, {0, 0}, {6, 0}},
                      {BoundaryKind::roller, {0, 0}, {0, 4}},
                      {BoundaryKind::roller, {6, 0}, {6, 2}}};
  scene.particles.spacing = spacing;
  scene.particles.arrangement = arrangement;
  scene.particles.disorder = 0.3;
  return scene;
}

std::vector<Point> places(const Case& scene) {
  std::vector<Point> at;
  for (const Site& site : place_particles(scene)) at.push_back(site.position);
  return at;
}

double area_of(const SoilMesh& mesh, const std::vector<Point>& corners) {
  double area = 0;
  for (const auto& t : mesh.triangles())
    area +=
        0.5 * doubled_area(corners[static_cast<std::size_t>(t[0])], corners[static_cast<std::size_t>(t[1])],
                           corners[static_cast<std::size_t>(t[2])]);
  return area;
}

}  // namespace

TEST_CASE("the triangles of the soil reach its outline, and linear values on them are exact") {
  const auto arrangement = GENERATE(Arrangement::fitted, Arrangement::disordered, Arrangement::surface);
  const double spacing = GENERATE(0.1, 0.2);
  const Case scene = layered_slope(arrangement, spacing);
  const std::vector<Point> at = places(scene);
  const SoilMesh mesh(&scene, at, at, spacing);
  const std::vector<Point> corners = mesh.at_corners(at, at);
  CHECK(area_of(mesh, corners) == Approx(area(scene.soils[0]) + area(scene.soils[1])).epsilon(1e-3));
  std::vector<double> values;
  for (const Point& p : at) values.push_back(3 + 2 * p.x() - 5 * p.y());
  const std::vector<double> all = mesh.at_corners(values);
  REQUIRE(all.size() == corners.size());
  double worst = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    worst = std::max(worst, std::abs(all[i] - (3 + 2 * corners[i].x() - 5 * corners[i].y())));
  CHECK(worst < 1e-9);
}

TEST_CASE("soil that is torn apart has no triangles across, and its particles are known") {
  const Case scene = layered_slope(Arrangement::fitted, 0.2);
  const std::vector<Point> at = places(scene);
  std::vector<Point> apart = at;
  for (Point& p : apart)
    if (p.x() > 3) p.x() += 2;
  const SoilMesh mesh(&scene, at, apart, 0.2);
  const std::vector<Point> corners = mesh.at_corners(apart, at);
  for (const auto& t : mesh.triangles()) {
    double low = 1e9, high = -1e9;
    for (const int i : t) {
      low = std::min(low, corners[static_cast<std::size_t>(i)].x());
      high = std::max(high, corners[static_cast<std::size_t>(i)].x());
    }
    CHECK(high - low < 1);
  }
  for (std::size_t i = 0; i < at.size(); ++i)
    if (std::abs(at[i].x() - 3) > 0.5) CHECK_FALSE(mesh.uncovered()[i]);
  CHECK(std::ranges::count(mesh.uncovered(), true) > 5);
}

TEST_CASE("labels of isolines keep off what is taken") {
  TriangleField field = square(4, [](Pixel p) { return p.y; });
  for (Pixel& p : field.points) p = {40 * p.x, 40 * p.y};  // 400 pixels wide
  const std::vector<double> levels = {5};
  const Box frame{0, 0, 400, 400}, probe{150, 180, 100, 40};
  const auto labelled = [&](std::vector<Box> taken) {
    TextsOnly device;
    Canvas canvas(device);
    draw_isolines(canvas, frame, field, levels, std::move(taken));
    REQUIRE_FALSE(device.texts.empty());
    return device.texts.back();
  };
  CHECK(labelled({}).x == Approx(200).margin(20));
  const Pixel moved = labelled({probe});
  CHECK(moved.y == Approx(200).margin(8));
  CHECK((moved.x < probe.x || moved.x > probe.right()));
}
