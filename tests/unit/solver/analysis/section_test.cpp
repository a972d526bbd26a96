// Sections of frames whose fields are known.
#include "solver/analysis/section.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "solver/analysis/exact_state.hpp"
#include "solver/analysis/grid_values.hpp"
#include "solver/reference/exact/finite_strain_column.hpp"
#include "solver/run/reference_errors.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

const Mat2 deformation = (Mat2() << 0.02, 0.05, 0, -0.03).finished();  // displacement gradient
Point displaced(const Point& start) { return start + deformation * start; }

/// A stress that is linear in present places, with coefficients of its own in each soil.
Stress stress_at(const Point& p, int soil) {
  const double jump = 3e3 * soil;
  return {-1e3 * p.x() - 2e3 * p.y() - jump, -5e3 + 1.5e3 * p.y() + 0.5 * jump, -700 * p.y(),
          200 * p.x() + jump};
}

/// Particles in the middle of cells of the soils' outlines, moved about by `noise` of a spacing, displaced
/// and stressed as above.
Frame frame_of(const Case& scene, double noise = 0) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-noise, noise);
  const double dx = scene.particles.spacing;
  std::vector<double> displacement, stress;
  std::vector<std::int32_t> soil;
  Frame frame;
  for (int k = 0; k < static_cast<int>(scene.soils.size()); ++k) {
    const Polygon& ring = scene.soils[static_cast<std::size_t>(k)].polygon;  // a rectangle
    for (double y = ring[0].y() + dx / 2; y < ring[2].y(); y += dx)
      for (double x = ring[0].x() + dx / 2; x < ring[2].x(); x += dx) {
        const Point start(x + dx * shift(random), y + dx * shift(random)), now = displaced(start);
        const Stress s = stress_at(now, k);
        frame.points.insert(frame.points.end(), {now.x(), now.y(), 0});
        displacement.insert(displacement.end(), {now.x() - start.x(), now.y() - start.y(), 0});
        stress.insert(stress.end(), {s.xx, s.yy, s.zz, s.xy, 0, 0});
        soil.push_back(k);
      }
  }
  const std::vector<double> ones(soil.size(), 1.0);
  frame.fields = {{"Displacement", {"X", "Y", "Z"}, displacement},
                  {"EffectiveStress", {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}, stress},
                  {"PorePressure", {}, std::vector<double>(soil.size(), -2e3)},
                  {"SoilId", {}, soil},
                  {"SmoothingLength", {}, std::vector<double>(soil.size(), scene.smoothing_length())},
                  {"Mass", {}, std::vector<double>(soil.size(), dx * dx)},
                  {"Density", {}, ones}};
  return frame;
}

void check_exact(const SectionPiece& piece) {
  const auto yy = values_of(piece.values, {"EffectiveStress", "YY"}),
             total = values_of(piece.values, {"TotalStress", "XX"}),
             shear = values_of(piece.values, {"MaximumShearStress", ""});
  double worst = 0;
  for (std::size_t i = 0; i < yy.size(); ++i) {
    const Point p(piece.values.points[3 * i], piece.values.points[3 * i + 1]);
    const Stress s = stress_at(p, std::max(0, piece.soil));
    worst = std::max({worst, std::abs(yy[i] - s.yy), std::abs(total[i] - (s.xx - 2e3)),
                      (displaced(piece.starts[i]) - p).norm()});
    CHECK(shear[i] >= std::hypot(0.5 * (s.xx - s.yy), s.xy) - 1e-6);
  }
  CHECK(worst < 1e-7);  // of 1e4
}

Case two_soils(double spacing) {
  Case scene = box_of_soil(1, 1, spacing);
  scene.soils[0].polygon = box_outline(0, 0, 2, 1);
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "upper";
  scene.soils[1].polygon = box_outline(0, 1, 2, 2);
  return scene;
}

}  // namespace

TEST_CASE("a section is exact for linear fields from wall to surface", "[section]") {
  for (const double spacing : {0.1, 0.25})
    for (const double noise : {0.0, 0.15}) {
      CAPTURE(spacing, noise);
      Case scene = box_of_soil(1, 1, spacing);
      scene.soils[0].polygon = box_outline(0, 0, 2, 3);
      const Frame frame = frame_of(scene, noise);
      const auto pieces = cut(frame, &scene, {{1, -1}, {1, 5}}, 100, {});
      REQUIRE(pieces.size() == 1);
      check_exact(pieces[0]);
      CHECK(pieces[0].starts.front().y() == Approx(0).margin(1e-8));
      CHECK(pieces[0].starts.back().y() == Approx(3).margin(1e-8));
      CHECK(pieces[0].along.front() == Approx(1).margin(1e-8));
      const auto slanting = cut(frame, &scene, {{-1, 0.3}, {0.7, 1.1}, {4, 1.7}}, 60, {});
      REQUIRE(slanting.size() == 1);
      check_exact(slanting[0]);
      CHECK(slanting[0].starts.front().x() == Approx(0).margin(1e-8));
      CHECK(slanting[0].starts.back().x() == Approx(2).margin(1e-8));
    }
}

TEST_CASE("a grid is exact for linear fields up to walls and surfaces, and ends where soil ends",
          "[section]") {
  for (const double spacing : {0.1, 0.25})
    for (const double noise : {0.0, 0.15}) {
      CAPTURE(spacing, noise);
      Case scene = two_soils(spacing);
      scene.soils[1].polygon = box_outline(0, 1, 1, 2);  // no soil in the upper right quarter
      const GridValues grid = values_on_grid(frame_of(scene, noise), &scene, 0.08, {});
      REQUIRE(grid.in_soil.size() == static_cast<std::size_t>(grid.columns * grid.rows));
      const auto yy = values_of(grid.values, {"EffectiveStress", "YY"});
      double worst = 0;
      int wrong = 0;
      std::size_t next = 0;
      for (std::size_t node = 0; node < grid.in_soil.size(); ++node) {
        const Point p = grid.low + grid.spacing * Point(static_cast<double>(node % grid.columns),
                                                        static_cast<double>(node / grid.columns));
        const Point start = (Mat2::Identity() + deformation).inverse() * p;
        const double below = std::max(0.0, start.x() - 1), margin = 0.03 * spacing;
        const bool inside = start.x() > margin && start.x() < 2 - margin && start.y() > margin &&
                            start.y() < (below > 0 ? 1 : 2) - margin && std::abs(start.x() - 1) > margin;
        const bool outside = start.x() < -margin || start.x() > 2 + margin || start.y() < -margin ||
                             start.y() > 2 + margin || (start.x() > 1 + margin && start.y() > 1 + margin);
        wrong += inside && !grid.in_soil[node];
        wrong += outside && grid.in_soil[node];
        if (!grid.in_soil[node]) continue;
        if (std::abs(start.y() - 1) > margin)  // between soils either one's value is right
          worst = std::max(worst, std::abs(yy[next] - stress_at(p, start.y() > 1).yy));
        ++next;
      }
      CHECK(wrong == 0);
      CHECK(worst < 1e-7);
      CHECK(next == grid.values.points.size() / 3);
    }
  const Case scene = two_soils(0.25);
  CHECK_THROWS_WITH(values_on_grid(frame_of(scene), &scene, 1e-5, {}), Contains("is too large"));
  CHECK_THROWS_AS(values_on_grid(frame_of(scene), &scene, 0, {}), std::invalid_argument);
  CHECK_THROWS_WITH(values_on_grid(frame_of(scene), &scene, 0.1, {{"Head", ""}}),
                    Contains("no field 'Head'"));
}

TEST_CASE("discharge through a section is that of a uniform flow, whatever way the line goes", "[section]") {
  Case scene = box_of_soil(1, 1, 0.1);
  scene.soils[0].polygon = box_outline(0, 0, 2, 3);
  Frame frame = frame_of(scene, 0.1);
  std::vector<double> flow;
  for (std::size_t i = 0; i < frame.points.size() / 3; ++i) flow.insert(flow.end(), {2e-6, -1e-6, 0});
  frame.fields.push_back({"DarcyVelocity", {"X", "Y", "Z"}, flow});
  const std::vector<Point> upwards = {{1, -1}, {1, 5}};
  const auto pieces = cut(frame, &scene, upwards, 50, {});
  const double height = pieces[0].along.back() - pieces[0].along.front();
  CHECK(flow_through(pieces) == Approx(-2e-6 * height));  // to the right of a line that goes up
  const auto bent = cut(frame, &scene, {{1, 1}, {1.3, 1.7}, {0.6, 2.1}}, 50, {});
  CHECK(flow_through(bent) == Approx(-2e-6 * (2.1 - 1) - 1e-6 * (0.6 - 1)));
}

TEST_CASE("a section may run along a wall", "[section]") {
  Case scene = box_of_soil(1, 1, 0.25);
  scene.soils[0].polygon = box_outline(0, 0, 2, 3);
  Frame frame = frame_of(scene);
  auto& u = std::get<std::vector<double>>(frame.fields[0].values);
  for (std::size_t i = 0; i < u.size(); i += 3) {  // the wall keeps its place, nearly
    frame.points[i] -= u[i] - 1e-4;
    u[i] = 1e-4;
  }
  const auto pieces = cut(frame, &scene, {{0, -1}, {0, 5}}, 100, {});
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].starts.front().y() == Approx(0).margin(0.006));
  CHECK(pieces[0].starts.back().y() == Approx(3).margin(0.006));
}

TEST_CASE("soils are not mixed where they meet", "[section]") {
  for (const double spacing : {0.1, 0.2}) {
    const Case scene = two_soils(spacing);
    const auto pieces = cut(frame_of(scene, 0.1), &scene, {{1, -1}, {1, 3}}, 90, {});
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].soil == 0);
    CHECK(pieces[1].soil == 1);
    for (const SectionPiece& piece : pieces) check_exact(piece);
    CHECK(pieces[0].starts.back().y() == Approx(1).margin(1e-8));
    CHECK(pieces[1].starts.front().y() == Approx(1).margin(1e-8));
  }
}

TEST_CASE("a section stops at gaps and holes, and the two sides are not mixed", "[section]") {
  const double spacing = 0.1;
  Case scene = two_soils(spacing);
  scene.soils[0].polygon = box_outline(0, 0, 1, 2);
  scene.soils[1].polygon = box_outline(1.05, 0, 2.05, 2);  // a slit of half a spacing
  const auto pieces = cut(frame_of(scene), &scene, {{-1, 1}, {3, 1}}, 200, {});
  REQUIRE(pieces.size() == 2);
  for (const SectionPiece& piece : pieces) check_exact(piece);
  CHECK(pieces[0].starts.back().x() == Approx(1).margin(1e-8));
  CHECK(pieces[1].starts.front().x() == Approx(1.05).margin(1e-8));
}

TEST_CASE("without a case a section ends beyond the outermost particles", "[section]") {
  Case scene = box_of_soil(1, 1, 0.25);
  scene.soils[0].polygon = box_outline(0, 0, 2, 3);
  const auto pieces = cut(frame_of(scene), nullptr, {{1, -1}, {1, 5}}, 100, {});
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].soil == -1);
  check_exact(pieces[0]);
  CHECK(pieces[0].starts.back().y() == Approx(3).margin(0.25));
}

TEST_CASE("strains are taken from all particles around a section", "[section]") {
  Case scene = box_of_soil(1, 1, 0.1);
  scene.soils[0].polygon = box_outline(0, 0, 2, 3);
  const auto pieces = cut(frame_of(scene), &scene, {{1, -1}, {1, 5}}, 50, {{"VolumetricStrain", ""}});
  REQUIRE(pieces.size() == 1);
  for (const double v : values_of(pieces[0].values, {"VolumetricStrain", ""}))
    CHECK(v == Approx(1.02 * 0.97 - 1).epsilon(1e-9));
}

TEST_CASE("the force through a section is the stress summed along it", "[section]") {
  Case scene = box_of_soil(1, 1, 0.1);
  scene.soils[0].polygon = box_outline(0, 0, 2, 3);
  const Frame frame = frame_of(scene);
  // Level cut from x = 0.05 y to 2.04 + 0.05 y, where the displaced sides are.
  const auto level = cut(frame, &scene, {{-1, 1}, {4, 1}}, 30, {});
  REQUIRE(level.size() == 1);
  const Point left(level[0].values.points[0], 1), right(*(level[0].values.points.end() - 3), 1);
  const SectionForce force = force_through(level, "EffectiveStress");
  CHECK(force.normal == Approx((right - left).norm() * stress_at(left, 0).yy));
  CHECK(force.shear == Approx((right - left).norm() * stress_at(0.5 * (left + right), 0).xy));
  CHECK(force_through(level, "TotalStress").normal == Approx(force.normal - 2e3 * (right - left).norm()));
}

TEST_CASE("what cannot be cut is refused or empty", "[section]") {
  Case scene = box_of_soil(1, 1, 0.25);
  scene.soils[0].polygon = box_outline(0, 0, 2, 3);
  const Frame frame = frame_of(scene);
  CHECK(cut(frame, &scene, {{9, -1}, {9, 5}}, 100, {}).empty());
  CHECK(cut(frame, &scene, {{2.7, -1}, {2.7, 5}}, 100, {}).empty());
  CHECK_THROWS_WITH(cut(frame, &scene, {{1, 1}, {1, 1}}, 100, {}), Contains("a line of some length"));
  CHECK_THROWS_WITH(cut(frame, &scene, {{1, 0}, {1, 1}}, 100, {{"Stres", ""}}),
                    Contains("it has Displacement"));
}

TEST_CASE("the exact state is that of the column", "[section]") {
  Case scene = box_of_soil(4, 8);
  hold_as_column(scene);
  add_water(scene, 5);
  scene.reference = Reference::column;
  const auto [column, bottom] = reference_column(scene);
  const FiniteStrainColumn exact(column);
  const auto frame = exact_state(scene, {{1, 0}, {1, 2}, {1, 4}});
  REQUIRE(frame);
  const auto yy = values_of(*frame, {"EffectiveStress", "YY"}),
             total = values_of(*frame, {"TotalStress", "YY"});
  CHECK(yy[0] == Approx(exact.vertical_stress(0)));
  CHECK(yy[2] == Approx(0).margin(1e-6));
  const double settled = 2 + exact.displacement(2);
  CHECK(total[1] == Approx(yy[1] - 9810 * (5 - settled)));
  CHECK(values_of(*frame, {"Head", ""})[1] == Approx(5));
  scene.reference = Reference::none;
  CHECK_FALSE(exact_state(scene, {{1, 0}}));
}
