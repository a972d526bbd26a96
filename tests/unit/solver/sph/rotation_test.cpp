#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

Mat2 rotation(double angle) {
  return (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}

/// A free, weightless, disordered body with a random stress that a rigid motion must only turn.
struct Spinning {
  Case scene = [] {
    Case c = box_of_soil(7, 6);
    c.particles.arrangement = Arrangement::disordered;
    c.particles.disorder = 0.2;
    c.loading.gravity_applied = false;
    return c;
  }();
  Model model = build_model(scene);
  Model start = [this] {
    Noise noise(9);
    for (Stress& s : model.particles.stress) s = {1e5 * noise(), 1e5 * noise(), 1e5 * noise(), 1e5 * noise()};
    return model;
  }();
  std::unique_ptr<Dynamics> dynamics;

  explicit Spinning(const FormulationCase& f) : dynamics(make_dynamics(f, model)) {}

  /// Moves every particle rigidly, with the velocity that the integrator would have had.
  void turn(double angle, int steps) {
    const double dt = 1e-3;
    const Mat2 step = rotation(angle / steps);
    Particles& p = model.particles;
    for (int i = 0; i < steps; ++i) {
      dynamics->prepare();
      for (std::size_t a = 0; a < p.size(); ++a) {
        const Vec2 next = step * p.position[a];
        p.velocity[a] = (next - p.position[a]) / dt;
        p.position[a] = next;
      }
      dynamics->strain(dt);
    }
  }

  std::vector<Vec2> accelerations() {
    std::vector<Vec2> a(model.particles.size());
    dynamics->prepare();
    dynamics->accelerations(a);
    return a;
  }
};

FormulationCase every_formulation() {
  FormulationCase f;
  f.motion = GENERATE(Motion::proposed, Motion::rho_squared, Motion::conventional, Motion::consistent);
  f.artificial_stress = f.motion == Motion::consistent ? 0 : 0.5;
  f.refresh_strain = GENERATE(0.0, 0.1, 5.0);
  return f;
}

}  // namespace

TEST_CASE("a block that turns keeps its stress in its own axes", "[motion]") {
  Spinning block(every_formulation());
  double angle = 0;
  for (int eighth = 0; eighth < 8; ++eighth) {
    block.turn(std::numbers::pi / 4, 20);
    angle += std::numbers::pi / 4;
    const Mat2 turn = rotation(angle);
    for (std::size_t a = 0; a < block.start.particles.size(); ++a) {
      const Stress &before = block.start.particles.stress[a], &now = block.model.particles.stress[a];
      CHECK((now.in_plane() - turn * before.in_plane() * turn.transpose()).norm() < 1e-10 * 1e5);
      CHECK(now.zz == Approx(before.zz).margin(1e-5));
      CHECK(block.model.particles.density[a] == Approx(block.start.particles.density[a]).epsilon(1e-12));
    }
  }
}

TEST_CASE("forces turn with the block", "[motion]") {
  Spinning block(every_formulation());
  const std::vector<Vec2> before = block.accelerations();
  block.turn(1.1, 30);
  const std::vector<Vec2> now = block.accelerations();
  for (std::size_t a = 0; a < before.size(); ++a) CHECK((now[a] - rotation(1.1) * before[a]).norm() < 1e-9);
}

TEST_CASE("the consistent form conserves momentum and does the work that the strain takes up", "[motion]") {
  Spinning block({.motion = Motion::consistent});
  const std::vector<Vec2> a = block.accelerations();
  const Particles& p = block.model.particles;
  Noise noise(2);
  for (Vec2& v : block.model.particles.velocity) v = noise.vector();
  std::vector<Mat2> gradient(p.size());
  block.dynamics->velocity_gradients(gradient);
  Vec2 momentum = Vec2::Zero();
  double power = 0, strain_power = 0, scale = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    momentum += p.mass[i] * a[i];
    power += p.mass[i] * a[i].dot(p.velocity[i]);
    strain_power += p.volume(i) * (p.stress[i].in_plane().cwiseProduct(gradient[i])).sum();
    scale += p.mass[i] * a[i].norm();
  }
  CHECK(momentum.norm() < 1e-13 * scale);
  CHECK(std::abs(power + strain_power) < 1e-13 * scale);
}
