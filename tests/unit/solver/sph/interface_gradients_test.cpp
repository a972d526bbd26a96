// Gradients of each particle's own side where soils meet.
#include "solver/sph/consistent/interface_gradients.hpp"

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/run/simulation.hpp"
#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/step_by_hand.hpp"

using namespace porosph;

namespace {

/// Two soils that meet in a straight line through (4, 4), at an angle to the x axis; weightless and free.
Case two_soils(double degrees, double contrast, double nu_below, double nu_above) {
  Case scene = box_of_soil(16, 16);
  const double rise = 4 * std::tan(degrees * std::acos(-1) / 180);
  SoilCase above = scene.soils[0];
  scene.soils[0].polygon = {{0, 0}, {8, 0}, {8, 4 + rise}, {0, 4 - rise}};
  above.polygon = {{0, 4 - rise}, {8, 4 + rise}, {8, 8}, {0, 8}};
  above.name = "above";
  above.youngs_modulus *= contrast;
  scene.soils[0].poissons_ratio = nu_below, above.poissons_ratio = nu_above;
  scene.soils.push_back(above);
  scene.loading.gravity_applied = false;
  scene.particles.arrangement = degrees == 0 ? Arrangement::lattice : Arrangement::fitted;
  scene.formulation = default_formulation(Motion::consistent);
  return scene;
}

/// The gradient in the upper soil of a displacement that has `below` in the lower one: continuous along the
/// line, with the same traction on it.
Mat2 gradient_above(const Model& model, const Mat2& below, double degrees) {
  const double angle = degrees * std::acos(-1) / 180;
  const Vec2 n(-std::sin(angle), std::cos(angle));
  const auto traction = [&](const Elasticity& soil, const Mat2& g) {
    const Stress s = soil.elastic_rate(Gradient(g));
    return Vec2(s.in_plane() * n);
  };
  const Elasticity &lower = model.soils[0].elastic(), &upper = model.soils[1].elastic();
  const Vec2 missing = traction(lower, below) - traction(upper, below);
  Mat2 acoustic;
  acoustic.col(0) = traction(upper, Vec2::UnitX() * n.transpose());
  acoustic.col(1) = traction(upper, Vec2::UnitY() * n.transpose());
  return below + Vec2(inverse(acoustic) * missing) * n.transpose();
}

}  // namespace

TEST_CASE("a gradient that bends where level soils meet is exact on both sides", "[interface]") {
  const double contrast = GENERATE(0.1, 10.0, 1e3);
  CAPTURE(contrast);
  Case scene = two_soils(0, contrast, 0.2, 0.4);
  Model model = build_model(scene);
  const Mat2 below = (Mat2() << 1e-3, 2e-3, -5e-4, -3e-3).finished();
  const Mat2 above = gradient_above(model, below, 0);
  Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 from_line = p.position[i] - Vec2(4, 4);
    p.velocity[i] = (p.soil[i] == 0 ? below : above) * from_line;
  }
  const auto dynamics = make_dynamics(scene.formulation, model);
  const std::vector<Mat2> gradients = velocity_gradients_of(*dynamics, model);
  for (std::size_t i = 0; i < p.size(); ++i) {
    // Beside the ends of the interface only its normal part is made up for, unless stiffness differs much.
    if (contrast < 30 && std::abs(p.position[i].x() - 4) > 4 - 2 * model.smoothing_length) continue;
    const Mat2& exact = p.soil[i] == 0 ? below : above;
    const Mat2 strain = gradients[i] + gradients[i].transpose(), expected = exact + exact.transpose();
    INFO(p.position[i].transpose());
    CHECK((strain - expected).norm() < 1e-9 * expected.norm());
  }
}

TEST_CASE("a bend that varies along the interface does not count as strain along it", "[interface]") {
  Case scene = two_soils(0, 1e3, 0.3, 0.3);
  Model model = build_model(scene);
  const Mat2 above = (Mat2() << 1e-6, 2e-6, -5e-7, -3e-6).finished();
  Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 from_line = p.position[i] - Vec2(4, 4);
    const double depth = std::max(0.0, -from_line.y());
    p.velocity[i] = above * from_line + depth * (1 + 0.2 * from_line.x()) * Vec2(2e-3, 3e-3);
  }
  const auto dynamics = make_dynamics(scene.formulation, model);
  const std::vector<Mat2> gradients = velocity_gradients_of(*dynamics, model);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.soil[i] == 1) {
      INFO(p.position[i].transpose());
      CHECK(gradients[i](0, 0) == Approx(above(0, 0)).epsilon(1e-6));
    }
}

TEST_CASE("own sides leave soils of one stiffness alone", "[interface]") {
  const Case scene = two_soils(0, 1, 0.3, 0.3);
  const Model model = build_model(scene);
  CHECK(make_reference(model, scene.formulation, Surroundings(model).find(model)).own_sides.empty());
}

TEST_CASE("a free body of two soils keeps its momentum and gains no energy", "[interface]") {
  const double degrees = GENERATE(0.0, 20.0);
  CAPTURE(degrees);
  Case scene = two_soils(degrees, 20, 0.1, 0.45);
  scene.time.end = 0.5, scene.time.courant = 0.5;
  scene.soils[1].velocity = Point(0.05, -0.1);
  scene.formulation.bulk_viscosity = 0;
  Simulation simulation(scene);
  const auto momentum = [&] {
    Vec2 sum = Vec2::Zero();
    const Particles& p = simulation.model().particles;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
    return sum;
  };
  const Vec2 before = momentum();
  const double energy = simulation.energy().total();
  double most = 0;
  while (simulation.step() < simulation.last_step()) {
    simulation.advance();
    REQUIRE_FALSE(simulation.instability());
    if (simulation.step() % 20 == 0) most = std::max(most, simulation.energy().total());
  }
  CHECK((momentum() - before).norm() < 1e-10 * before.norm());
  CHECK(most < 1.01 * energy);
}
