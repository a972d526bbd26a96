#include <catch2/catch.hpp>
#include <cmath>

#include "solver/sph/dynamics.hpp"
#include "solver/sph/stabilisation/artificial_stress.hpp"
#include "solver/sph/stabilisation/artificial_viscosity.hpp"
#include "solver/sph/stabilisation/bulk_viscosity.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

TEST_CASE("artificial viscosity of a pair, by hand", "[stabilisation]") {
  const double h = 0.6, c = 50, rho = 2000, vx = -0.3, r2 = 0.25;
  // phi = 0.6 * -0.3 / (0.25 + 0.01 * 0.36) = -0.709779
  CHECK(ArtificialViscosity{0.1, 0}.pair(vx, r2, h, c, rho) == Approx(5 * 0.70977918 / 2000));
  CHECK(ArtificialViscosity{0, 0.2}.pair(vx, r2, h, c, rho) == Approx(0.2 * 0.50378648 / 2000));
  CHECK(ArtificialViscosity{0.1, 0.2}.pair(vx, r2, h, c, rho) == Approx(1.8248266e-3));
  CHECK(ArtificialViscosity{0.1, 0.2}.pair(0.3, r2, h, c, rho) == 0);  // the pair parts
  CHECK(ArtificialViscosity{0.1, 0}.active());
  CHECK_FALSE(ArtificialViscosity{}.active());
}

TEST_CASE("artificial stress, by hand", "[stabilisation]") {
  const double rho = 20, epsilon = 0.5;
  const auto r = [&](const Stress& s) { return artificial_stress(s, rho, epsilon); };
  CHECK((r({.xx = 800}) - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-15);
  CHECK((r({.xx = -800, .yy = 1600}) - Eigen::Vector3d(0, -2, 0)).norm() < 1e-15);
  CHECK(r({.xx = -800, .yy = -1600, .xy = 300}).norm() == 0);
  CHECK(r({.zz = 5e3}).norm() == 0);
  CHECK((r({.xy = 800}) - Eigen::Vector3d(-0.5, -0.5, -0.5)).norm() < 1e-15);  // tension at +45 degrees
  CHECK((r({.xy = -800}) - Eigen::Vector3d(-0.5, -0.5, 0.5)).norm() < 1e-15);  // at -45 degrees
}

TEST_CASE("artificial stress turns with the stress", "[stabilisation]") {
  const auto tensor = [](const Eigen::Vector3d& r) { return (Mat2() << r[0], r[2], r[2], r[1]).finished(); };
  const Stress stress{.xx = 700, .yy = -300, .xy = 450};
  const Mat2 upright = tensor(artificial_stress(stress, 20, 0.5));
  for (double angle = 0.1; angle < 3.2; angle += 0.3) {
    const Mat2 turn =
        (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
    const Mat2 s = turn * stress.in_plane() * turn.transpose();
    const Mat2 turned = tensor(artificial_stress({.xx = s(0, 0), .yy = s(1, 1), .xy = s(0, 1)}, 20, 0.5));
    CHECK((turned - turn * upright * turn.transpose()).norm() < 1e-14);
  }
}

TEST_CASE("bulk viscosity acts in compression only", "[stabilisation]") {
  CHECK(bulk_viscosity(0.06, 2e5, -0.5) == Approx(-6e3));
  CHECK(bulk_viscosity(0.06, 2e5, 0.5) == 0);
  CHECK(bulk_viscosity(0, 2e5, -0.5) == 0);
}

TEST_CASE("no viscosity feels a drift or a spin of the whole body", "[stabilisation]") {
  Case scene = box_of_soil(8, 6);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.2;
  scene.formulation.motion = GENERATE(Motion::proposed, Motion::consistent);
  if (scene.formulation.motion == Motion::consistent)
    scene.formulation.zero_energy_control = 0.05, scene.formulation.bulk_viscosity = 0.06;
  else
    scene.formulation.artificial_viscosity_alpha = 0.1, scene.formulation.artificial_viscosity_beta = 0.2;
  const auto accelerations = [&](const Mat2& gradient, double wobble) {
    Model model = build_model(scene);
    Noise noise(5);
    Particles& p = model.particles;
    for (std::size_t a = 0; a < p.size(); ++a)
      p.velocity[a] = Vec2(3, -8) + gradient * p.position[a] + wobble * noise.vector();
    const auto dynamics = make_dynamics(scene.formulation, model);
    std::vector<Vec2> a(p.size());
    dynamics->prepare();
    dynamics->accelerations(a);
    double largest = 0;
    for (const Vec2& v : a) largest = std::max(largest, (v - model.gravity).norm());
    return largest;
  };
  const Mat2 spin = (Mat2() << 0, -2, 2, 0).finished();
  CHECK(accelerations(spin, 0) < 1e-9);
  CHECK(accelerations(-Mat2::Identity(), 0) > 1);
  CHECK(accelerations(spin, 0.1) > 1);
}

TEST_CASE("the zero-energy control feels no linear velocity", "[stabilisation]") {
  Case scene = box_of_soil(8, 6);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.2;
  scene.formulation.zero_energy_control = 0.05;
  Model model = build_model(scene);
  const Mat2 gradient = (Mat2() << 0.3, -0.8, 0.5, -0.7).finished();
  for (std::size_t a = 0; a < model.particles.size(); ++a)
    model.particles.velocity[a] = gradient * model.particles.position[a];
  const auto dynamics = make_dynamics(scene.formulation, model);
  std::vector<Vec2> found(model.particles.size());
  dynamics->prepare();
  dynamics->accelerations(found);
  for (const Vec2& a : found) CHECK((a - model.gravity).norm() < 1e-10);
}
