// Motion that no gradient sees: a chequerboard of velocities.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

double sign(const Model& model, std::size_t i) {
  const Vec2 cell = model.particles.start[i] / model.spacing;
  return (static_cast<int>(cell.x()) + static_cast<int>(cell.y())) % 2 == 0 ? 1 : -1;
}

/// How much of a chequerboard of small velocities is left in a free block after some steps.
double left_of_chequerboard(double control, Arrangement arrangement, int steps) {
  Case scene = box_of_soil(16, 16, 0.1);
  scene.loading.gravity_applied = false;
  scene.particles.arrangement = arrangement;
  scene.particles.disorder = arrangement == Arrangement::disordered ? 0.1 : 0;
  scene.formulation.zero_energy_control = control;
  Model model = build_model(scene);
  const auto dynamics = make_dynamics(scene.formulation, model);
  Particles& p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = Vec2(1e-3, 0) * sign(model, i);
  const double dt = 0.5 * model.smoothing_length / model.wave_speed;
  std::vector<Vec2> a(p.size());
  const auto chequerboard = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.velocity[i].x() * sign(model, i);
    return sum;
  };
  const double planted = chequerboard();
  double largest = 0;  // over the last steps, as what is left may swing
  for (int n = 0; n < steps; ++n) {
    dynamics->prepare();
    dynamics->accelerations(a);
    for (std::size_t i = 0; i < p.size(); ++i)
      p.velocity[i] += dt * a[i], p.position[i] += dt * p.velocity[i];
    dynamics->strain(dt);
    if (n >= steps - 10) largest = std::max(largest, std::abs(chequerboard() / planted));
  }
  return largest;
}

}  // namespace

TEST_CASE("a planted chequerboard persists without zero-energy control and decays with it") {
  for (const Arrangement arrangement : {Arrangement::lattice, Arrangement::disordered}) {
    CAPTURE(static_cast<int>(arrangement));
    CHECK(left_of_chequerboard(0, arrangement, 50) > 0.3);
    CHECK(left_of_chequerboard(0.05, arrangement, 50) < 0.1);
    CHECK(left_of_chequerboard(0.3, arrangement, 50) < 0.01);
  }
}
