// A strip load on elastic ground: particles against finite elements, finite elements against Flamant's
// theory.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/case/case_file.hpp"
#include "solver/reference/fem/mesh.hpp"
#include "solver/reference/fem/solve.hpp"
#include "solver/run/simulation.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr double q = 20e3;

/// The right half of weightless ground, wide and deep, with a strip load of half width 2 m.
Case half_space(double wide, double deep) {
  Case scene = box_of_soil(2, 2, 0.25);
  SoilCase& soil = scene.soils[0];
  soil.polygon = {{0, -deep}, {wide, -deep}, {wide, 0}, {0, 0}};
  soil.youngs_modulus = 20e6, soil.poissons_ratio = 0.3;
  add_wall(scene, BoundaryKind::fixed, {0, -deep}, {wide, -deep});
  add_wall(scene, BoundaryKind::roller, {0, -deep}, {0, 1});
  add_wall(scene, BoundaryKind::roller, {wide, -deep}, {wide, 1});
  LoadCase strip;
  strip.name = "strip", strip.from = {0, 0}, strip.to = {2, 0};
  strip.pressure = strip.pressure_to = q;
  scene.loads.push_back(strip);
  scene.loading.gravity_applied = false;
  return scene;
}

}  // namespace

TEST_CASE("finite elements under a strip load have the stress of theory", "[load]") {
  const Case scene = half_space(80, 80);
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 2));
  // 1.7 % of q: sides and bottom are 80 m away, not infinitely far. Uniform strip from -b to b (Flamant
  // 1892): a = angle that it spans seen from the point, d = to its far side.
  for (const Point& at : {Point(0, -1), Point(0, -3), Point(1, -2), Point(3, -2), Point(5, -4)}) {
    CAPTURE(at.x(), at.y());
    const double depth = -at.y(), right = std::atan2(at.x() - 2, depth), left = std::atan2(at.x() + 2, depth);
    const double a = left - right, sum = left + right;
    const auto stress = fem.at(at).effective_stress;
    CHECK(stress[1] == Approx(-q / std::numbers::pi * (a + std::sin(a) * std::cos(sum))).margin(0.02 * q));
    CHECK(stress[0] == Approx(-q / std::numbers::pi * (a - std::sin(a) * std::cos(sum))).margin(0.02 * q));
    CHECK(std::abs(stress[3]) ==
          Approx(std::abs(q / std::numbers::pi * std::sin(a) * std::sin(sum))).margin(0.02 * q));
  }
}

TEST_CASE("particles under a strip load have the stress of finite elements", "[load]") {
  const double width = GENERATE(1.9, 2.0, 2.125);  // that ends beside, between and on particles
  CAPTURE(width);
  Case scene = half_space(12, 8);
  scene.loads[0].to.x() = width;
  const FemSolution fem = solve_fem(scene, mesh_rectangle(scene, 0.25));
  scene.particles.arrangement = Arrangement::surface, scene.particles.smoothing_ratio = 1;
  scene.formulation = default_formulation(Motion::consistent);
  scene.loading.adaptive_damping = true;
  scene.time.courant = 0.6, scene.time.end = 3;
  Simulation s(scene);
  while (s.step() < s.last_step() && (s.step() % 20 != 0 || s.unbalanced_force_ratio() > 1e-5)) s.advance();
  CHECK(s.step() < s.last_step());
  const Particles& p = s.model().particles;
  double errors = 0, sum = 0, near = 0, far = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double from_edge = (p.start[i] - Vec2(width, 0)).norm() / scene.particles.spacing;
    const double exact = fem.at(p.start[i]).effective_stress[1], off = std::abs(p.stress[i].yy - exact);
    if (from_edge < 2) continue;
    errors += off * off, sum += exact * exact;
    near = std::max(near, off);
    if (from_edge > 8) far = std::max(far, off);
  }
  CAPTURE(std::sqrt(errors / sum), near / q, far / q);
  CHECK(std::sqrt(errors / sum) < 0.0055);
  CHECK(near < 0.018 * q);
  CHECK(far < 0.005 * q);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.start[i].x() < scene.particles.spacing) {
      const FemPoint exact = fem.at(p.start[i]);
      CHECK(p.stress[i].yy == Approx(exact.effective_stress[1]).margin(0.0012 * q));
      CHECK(p.displacement(i).y() == Approx(exact.displacement.y()).margin(0.000012));
    }
}
