// Gradients of disordered particles that are closed: what they gain, and that they lose nothing.
#include "solver/sph/consistent/closed_gradients.hpp"

#include <omp.h>

#include <catch2/catch.hpp>

#include "solver/case/case_file.hpp"
#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/step_by_hand.hpp"

using namespace porosph;

namespace {

/// Weightless, between rollers at three sides.
Case column(double disorder) {
  Case scene = box_of_soil(14, 16);
  hold_as_column(scene, BoundaryKind::roller);
  scene.loading.gravity_applied = false;
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = disorder;
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.bulk_viscosity = scene.formulation.zero_energy_control = 0;
  return scene;
}

struct Scene {
  explicit Scene(const Case& scene)
      : model(build_model(scene)), dynamics(make_dynamics(scene.formulation, model)) {}

  std::vector<Vec2> accelerations() { return accelerations_of(*dynamics, model); }
  std::vector<Mat2> velocity_gradients() { return velocity_gradients_of(*dynamics, model); }

  Model model;
  std::unique_ptr<Dynamics> dynamics;
};

Stress noisy_stress(Noise& noise) { return {1e4 * noise(), 1e4 * noise(), 1e4 * noise(), 1e4 * noise()}; }

/// RMS of rho a dx over the stress, at depths at which no particle sees the surface.
double imbalance(Scene scene) {
  Particles& p = scene.model.particles;
  const double stress = 1e4;
  for (Stress& s : p.stress) s = {stress, stress, stress, 0};
  const std::vector<Vec2> a = scene.accelerations();
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (p.start[i].y() < 8 - 4 * scene.model.smoothing_length)
      squares += a[i].squaredNorm() * p.density[i] * p.density[i], ++count;
  REQUIRE(count > 50);
  return scene.model.spacing * std::sqrt(squares / count) / stress;
}

}  // namespace

TEST_CASE("a uniform stress is in balance inside and at rollers, however large the disorder") {
  const double disorder = GENERATE(0.05, 0.2, 0.4);
  CAPTURE(disorder);
  Case open = column(disorder);
  open.formulation.closed_gradients = false;
  CHECK(imbalance(Scene(open)) > 0.5 * disorder);
  CHECK(imbalance(Scene(column(disorder))) < 2e-3);
}

TEST_CASE("closed gradients are the adjoint of the forces, walls included") {
  Case between_rollers = column(0.3);
  between_rollers.boundaries.erase(
      between_rollers.boundaries.begin());  // behind the bottom, stress is not mirrored
  Scene scene(between_rollers);
  Noise noise(7);
  Particles& p = scene.model.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    p.stress[i] = noisy_stress(noise), p.velocity[i] = noise.vector();
  const std::vector<Vec2> a = scene.accelerations();
  const std::vector<Mat2> g = scene.velocity_gradients();
  double power = 0, work = 0, size = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    power += p.mass[i] * a[i].dot(p.velocity[i]);
    const double w = p.volume(i) * p.stress[i].in_plane().cwiseProduct(g[i]).sum();
    work += w, size += std::abs(w);
  }
  CHECK(std::abs(power + work) < 1e-13 * size);
}

TEST_CASE("closed gradients of linear fields are exact, of velocity and of pore pressure") {
  Case scene = column(0.25);
  add_water(scene, 20);
  scene.boundaries.clear();
  Scene all(scene);
  Particles& p = all.model.particles;
  const Mat2 field = (Mat2() << 1, 2, -1, 0.5).finished();
  for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = Vec2(3, 5) + field * p.position[i];
  for (const Mat2& g : all.velocity_gradients()) CHECK((g - field).norm() < 1e-11);

  // Without stress, gravity is lessened by the uplift of hydrostatic pore pressure alone.
  for (Vec2& v : p.velocity) v.setZero();
  const std::vector<Vec2> a = all.accelerations();
  for (std::size_t i = 0; i < p.size(); ++i)
    CHECK((a[i] - Vec2(0, scene.water.unit_weight / p.density[i])).norm() < 1e-10);
}

TEST_CASE("a lattice is closed as it is") {
  const auto after_steps = [](bool closed) {
    Case scene = column(0);
    scene.particles.arrangement = Arrangement::lattice;
    scene.loading.gravity_applied = true;
    scene.formulation.closed_gradients = closed;
    Scene s(scene);
    step_by_hand(*s.dynamics, s.model, 1e-3, 20);
    return s.model.particles.velocity;
  };
  CHECK(after_steps(true) == after_steps(false));
}

TEST_CASE("closed gradients do not depend on the number of threads") {
  const auto accelerations = [](int threads) {
    omp_set_num_threads(threads);
    Scene s(column(0.4));
    Noise noise(3);
    for (Stress& stress : s.model.particles.stress) stress = noisy_stress(noise);
    return s.accelerations();
  };
  const int usual = omp_get_max_threads();
  CHECK(accelerations(1) == accelerations(3));
  omp_set_num_threads(usual);
}
