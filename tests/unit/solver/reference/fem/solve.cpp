#include "solver/reference/fem/solve.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes.hpp"

using namespace porosph;
using Catch::Matchers::Contains;

namespace {

constexpr double tolerance = 1e-8;  // relative to the largest value

/// A column under its buoyant weight: gamma' below `level`, dry weight above; both linear elastic.
struct Column {
  double height, level, wet_weight, dry_weight, modulus, k0;
  double stress(double y) const {
    const double wet = std::min(level, height);
    return y > wet ? -dry_weight * (height - y) : -dry_weight * (height - wet) - wet_weight * (wet - y);
  }
  double settlement(double y) const {
    const double wet = std::min(level, height), below = std::min(y, wet), above = y - below;
    return (stress(0) + stress(below)) / 2 * below / modulus +
           (stress(below) + stress(y)) / 2 * above / modulus;
  }
};

Column column_of(const Case& scene) {
  const SoilCase& soil = scene.soils[0];
  return {10,
          scene.water.present() ? scene.water.stretches[0].level : 0,
          soil.unit_weight_saturated - scene.water.unit_weight,
          soil.unit_weight_unsaturated,
          test::constrained_modulus(soil),
          soil.poissons_ratio / (1 - soil.poissons_ratio)};
}

void check_column(const FemSolution& solution, const Column& exact) {
  const double stress = std::abs(exact.stress(0)), settlement = std::abs(exact.settlement(exact.height));
  for (const double x : {0.0, 0.01, 7.5, 11.3, 15.0})
    for (const double y : {0.0, 0.3, 5.0, 6.0, 8.77, 10.0}) {
      const FemPoint p = solution.at({x, y});
      CAPTURE(x, y);
      CHECK(std::abs(p.displacement.x()) < tolerance * settlement);
      CHECK(std::abs(p.displacement.y() - exact.settlement(y)) < tolerance * settlement);
      CHECK(std::abs(p.effective_stress[0] - exact.k0 * exact.stress(y)) < tolerance * stress);
      CHECK(std::abs(p.effective_stress[1] - exact.stress(y)) < tolerance * stress);
      CHECK(std::abs(p.effective_stress[2] - exact.k0 * exact.stress(y)) < tolerance * stress);
      CHECK(std::abs(p.effective_stress[3]) < tolerance * stress);
      const double p_w = y < exact.level ? -9810 * (exact.level - y) : 0;
      CHECK(p.pore_pressure == Approx(p_w).margin(1e-6));
      CHECK(p.total_stress()[1] == Approx(p.effective_stress[1] + p_w).margin(1e-6));
    }
}

/// Moves inner vertices by up to 0.3 of the edge length, by a fixed pattern.
Mesh distorted(Mesh mesh, double h) {
  for (Point& p : mesh.vertices)
    if (p.x() > 0 && p.x() < 15 && p.y() > 0 && p.y() < 10)
      p +=
          0.3 * h * Point(std::sin(7 * p.x() + 3 * p.y()), std::cos(5 * p.x() - 11 * p.y())) / std::sqrt(2.0);
  return mesh;
}

}  // namespace

TEST_CASE("The submerged foundation is exact: linear stress, quadratic displacement") {
  const Case scene = test::foundation();
  const FemSolution solution = solve_fem(scene, mesh_rectangle(scene, 2.5));
  check_column(solution, column_of(scene));
  CHECK(solution.unknowns == 25 * 16 + 23 * 16);  // 25 x 17 nodes, bottom row held, the two sides half
  CHECK(solution.seconds > 0);
}

TEST_CASE("Patch test: the exact foundation also on distorted triangles") {
  const Case scene = test::foundation();
  check_column(solve_fem(scene, distorted(mesh_rectangle(scene, 1.5), 1.5)), column_of(scene));
}

TEST_CASE("Above the water level the soil has its unsaturated weight and no pore pressure") {
  Case scene = test::foundation();
  scene.water.stretches[0].level = 6;
  check_column(solve_fem(scene, mesh_rectangle(scene, 2.5)), column_of(scene));
  scene.water.stretches.clear();
  check_column(solve_fem(scene, mesh_rectangle(scene, 2.5)), column_of(scene));
}

TEST_CASE("Without gravity dry soil stays as it is") {
  Case scene = test::foundation();
  scene.loading.gravity_applied = false;
  scene.water.stretches.clear();
  CHECK(solve_fem(scene, mesh_rectangle(scene, 5)).displacement().norm() == 0);
}

TEST_CASE(
    "A step of the water level presses on the soil: the horizontal force is the same on both sides of it") {
  Case scene = test::foundation();
  scene.water.stretches = {{-never, 7.5, 15}, {7.5, never, 12}};
  scene.boundaries[2].kind = BoundaryKind::roller;
  scene.boundaries.push_back({BoundaryKind::roller, {0, 10}, {15, 10}});
  const FemSolution solution = solve_fem(scene, mesh_rectangle(scene, 1));
  const auto force = [&](double x) {  // of effective and total stress over the height, midpoint rule
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int i = 0; i < 1000; ++i) {
      const FemPoint p = solution.at({x, 0.005 + 0.01 * i});
      sum += 0.01 * Eigen::Vector2d(p.effective_stress[0], p.total_stress()[0]);
    }
    return sum;
  };
  const Eigen::Vector2d left = force(3.3), right = force(11.7);
  CHECK(left[1] == Approx(right[1]).epsilon(1e-6));
  CHECK(left[0] - right[0] == Approx(9810 * 3 * 10).epsilon(1e-5));
}

TEST_CASE("A roller in any direction lets the soil slide along it, without friction") {
  Case scene = test::foundation();
  scene.soils[0].polygon = {{0, 0}, {12, 4}, {12, 10}, {0, 10}};
  scene.boundaries = {{BoundaryKind::roller, {12, 4}, {12, 10}}, {BoundaryKind::roller, {0, 0}, {12, 4}}};
  Mesh mesh = mesh_rectangle(test::foundation(), 1);
  for (Point& p : mesh.vertices) {
    p.x() *= 12.0 / 15;
    p.y() = p.x() / 3 + p.y() / 10 * (10 - p.x() / 3);
  }
  const FemSolution solution = solve_fem(scene, mesh);
  const Point along = Point(3, 1).normalized(), across(-along.y(), along.x());
  for (const double x : {3.1, 6.0, 8.7}) {
    const FemPoint p = solution.at({x, x / 3});
    Eigen::Matrix2d stress;
    stress << p.effective_stress[0], p.effective_stress[3], p.effective_stress[3], p.effective_stress[1];
    CHECK(std::abs(p.displacement.dot(across)) < 1e-12);
    CHECK(std::abs(p.displacement.dot(along)) > 1e-4);
    const double normal = across.dot(stress * across);
    CHECK(normal < -10e3);
    CHECK(std::abs(along.dot(stress * across)) < 1e-4 * std::abs(normal));
  }
}

TEST_CASE("Soil that nothing holds is an error that names the motion") {
  Case scene = test::foundation();
  const Mesh mesh = mesh_rectangle(scene, 5);
  SECTION("between rollers only") {
    scene.boundaries.pop_back();
    CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("free to move along (0, 1)"));
  }
  SECTION("on a roller only") {
    scene.boundaries = {{BoundaryKind::roller, {0, 0}, {15, 0}}};
    CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("free to move along (1, 0)"));
  }
  SECTION("on a point") {
    scene.boundaries = {{BoundaryKind::fixed, {-1, 0}, {0, 0}}};
    CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("free to turn"));
  }
  SECTION("nowhere") {
    scene.boundaries.clear();
    CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("no boundary holds the soil"));
  }
  SECTION("by a boundary elsewhere") {
    for (BoundaryCase& boundary : scene.boundaries) boundary.from.y() = boundary.to.y() = -3;
    CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("no boundary holds the soil"));
  }
}

TEST_CASE("Soil that hangs on a single point is an error") {
  Case scene = test::foundation();
  scene.soils[0].polygon = {{0, 0}, {15, 0}, {15, 10}, {0, 10}};
  Mesh mesh = mesh_rectangle(scene, 5);
  const int corner = static_cast<int>(mesh.vertices.size()) - 1;
  mesh.vertices.insert(mesh.vertices.end(), {{18, 10}, {18, 13}});
  mesh.triangles.push_back({corner, corner + 1, corner + 2});
  mesh.soils.push_back(0);
  CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("free to turn") && Contains("single point"));
}

TEST_CASE("What the reference cannot answer is an error") {
  Case scene = test::foundation();
  const Mesh mesh = mesh_rectangle(scene, 5);
  CHECK_THROWS_WITH(solve_fem(scene, mesh).at({15.1, 3}), Contains("(15.1, 3) is outside"));
  scene.loading.k0_stress = true;
  CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("k0_stress"));
  scene.loading.k0_stress = false;
  scene.water.stretches[0].level = 6;
  CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("water level, y at 6 m cuts through"));
  scene.water.stretches[0] = {-never, 7, 15};
  CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("end of a water stretch, x at 7 m"));
  scene.water.stretches.clear();
  scene.soils[0].poissons_ratio = 0.5;
  CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("'sand'") && Contains("nu = 0.5"));
}

TEST_CASE("Mean tension is reported where the soil cannot carry it") {
  Case scene = test::foundation();
  const Mesh mesh = mesh_rectangle(scene, 5);
  scene.water.unit_weight = 30e3;  // buoyancy above the weight: tension gamma' * depth
  CHECK(largest_mean_tension(scene, solve_fem(scene, mesh)) == 0);
  scene.soils[0].no_tension = true;
  const Column column = column_of(scene);
  CHECK(largest_mean_tension(scene, solve_fem(scene, mesh)) ==
        Approx(column.stress(0) * (1 + 2 * column.k0) / 3).epsilon(1e-8));
}

// A layered column is exact in finite elements whatever the contrast: the weight above, and the settlement of
// each layer under it. The layers' parting line is a line of the structured mesh.
TEST_CASE("Stiffness contrasts of up to 10^8, either way round, cost no accuracy") {
  for (const double contrast : {1.0, 1e2, 1e4, 1e6, 1e8})
    for (const bool stiff_above : {true, false})
      for (const double h : {2.5, 1.0}) {
        Case scene = test::foundation();
        scene.water.stretches.clear();
        Mesh mesh = mesh_rectangle(scene, h);
        scene.soils.push_back(scene.soils[0]);  // the mesh says where it is
        scene.soils[1].name = "rock";
        scene.soils[1].youngs_modulus *= contrast;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
          const auto& v = mesh.triangles[t];
          const double y = (mesh.vertices[v[0]].y() + mesh.vertices[v[1]].y() + mesh.vertices[v[2]].y()) / 3;
          mesh.soils[t] = (y > 5) == stiff_above ? 1 : 0;
        }
        const FemSolution solution = solve_fem(scene, mesh);
        CAPTURE(contrast, stiff_above, h, solution.rounding);
        CHECK(solution.rounding < 1e-5);
        const double weight = scene.soils[0].unit_weight_unsaturated;
        const auto modulus = [&](bool above) {
          return test::constrained_modulus(scene.soils[above == stiff_above ? 1 : 0]);
        };
        const double lower = -weight * 10 * 5 / modulus(false) + weight * 5 * 5 / 2 / modulus(false);
        const double upper = -weight * 5 * 5 / 2 / modulus(true);
        CHECK(solution.at({7.5, 5}).displacement.y() == Approx(lower).epsilon(1e-5));
        CHECK(solution.at({7.5, 10}).displacement.y() == Approx(lower + upper).epsilon(1e-5));
        for (const double y : {1.3, 4.1, 6.2, 8.7})
          CHECK(std::abs(solution.at({3.7, y}).effective_stress[1] + weight * (10 - y)) < 1e-4 * weight * 10);
      }
}

TEST_CASE("A contrast that leaves no digits is named, soil by soil") {
  Case scene = test::foundation();
  Mesh mesh = mesh_rectangle(scene, 2.5);
  scene.soils.push_back(scene.soils[0]);
  scene.soils[1].name = "rock";
  scene.soils[1].youngs_modulus *= 1e14;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.soils[t] = mesh.vertices[mesh.triangles[t][0]].y() > 5 ? 1 : 0;
  CHECK_THROWS_WITH(solve_fem(scene, mesh), Contains("rounding spoils the solution") &&
                                                Contains("'rock' is 1e+14 times as stiff as soil 'sand'"));
}
