// Large rotations: stress turns with the body; a free body keeps its momenta and its energy.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/sph/dynamics.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;
using namespace porosph::verification;

namespace {

Mat2 turn(double angle) {
  return (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}

/// Turns a block with uniform stress rigidly and returns the largest error of stress over stress, and of
/// density.
double stress_error_of_rigid_turns(const Settings& settings, int turns, int steps_per_turn) {
  const Case block = scene("rotation", settings);
  Model model = build_model(block);
  const Stress start{.xx = -3e4, .yy = -5e4, .zz = -2e4, .xy = 1e4};
  model.particles.stress.assign(model.particles.size(), start);
  const double density = model.particles.density[0];
  const auto dynamics = make_dynamics(block.formulation, model);
  const double dt = 1e-3, angle = 2 * M_PI / steps_per_turn;
  double largest = 0;
  for (int step = 1; step <= turns * steps_per_turn; ++step) {
    dynamics->prepare();
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
      const Vec2 next = turn(angle * step) * model.particles.start[i];
      model.particles.velocity[i] = (next - model.particles.position[i]) / dt;
      model.particles.position[i] = next;
    }
    dynamics->strain(dt);
    const Mat2 exact = turn(angle * step) * start.in_plane() * turn(angle * step).transpose();
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
      const Stress& s = model.particles.stress[i];
      largest = std::max({largest, (s.in_plane() - exact).norm() / exact.norm(),
                          std::abs(s.zz / start.zz - 1), std::abs(model.particles.density[i] / density - 1)});
    }
  }
  return largest;
}

/// About the origin, at the present instant.
double angular_momentum(Simulation& s) {
  const std::vector<Vec2> v = s.velocities();
  const Particles& p = s.model().particles;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += p.mass[i] * (p.position[i].x() * v[i].y() - p.position[i].y() * v[i].x());
  return sum;
}

Vec2 momentum(Simulation& s) {
  const std::vector<Vec2> v = s.velocities();
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < v.size(); ++i) sum += s.model().particles.mass[i] * v[i];
  return sum;
}

}  // namespace

TEST_CASE("rotation: stress and density follow three rigid turns") {
  for (const Settings& settings : {Settings{}, Settings{"formulation.motion=proposed"}})
    expect({"rotation", settings, "stress and density after three turns of 100 steps, imposed",
            "rotated tensor", metres(0.1)},
           stress_error_of_rigid_turns(settings, 3, 100), 5e-12, scientific);
}

/// Strength with which the stress of these turns is just on Mohr and Coulomb's surface, to 16 digits.
Settings yielding() {
  const double sine = std::sin(20 * M_PI / 180), radius = std::hypot(1e4, 1e4);
  const double largest = -2e4, least = -4e4 - radius;  // tension positive
  const double c = (largest - least + (largest + least) * sine) / (2 * std::sqrt(1 - sine * sine));
  return {"soil.block.law=mohr_coulomb", "soil.block.friction_angle=20",
          fmt::format("soil.block.cohesion={:.17g}", c)};
}

TEST_CASE("rotation: a block on its yield surface keeps its stress over three rigid turns") {
  expect({"rotation", yielding(), "stress and density of a yielding block after three turns, imposed",
          "rotated tensor", metres(0.1)},
         stress_error_of_rigid_turns(yielding(), 3, 100), 5e-12, scientific);
}

TEST_CASE("rotation: a spinning block keeps momenta and energy") {
  const Settings drifting = {"soil.block.velocity=[1, 0.5]", "formulation.bulk_viscosity=0",
                             "formulation.zero_energy_control=0"};
  Simulation s(scene("rotation", drifting));
  const double spin = angular_momentum(s), energy = s.energy().total();
  const Vec2 impulse = momentum(s);
  double spin_drift = 0, energy_drift = 0, impulse_drift = 0;
  RunWatch watch;
  watch.progress = [&](const Simulation&) {
    if (s.step() % 20 != 0) return;
    spin_drift = std::max(spin_drift, std::abs(angular_momentum(s) / spin - 1));
    energy_drift = std::max(energy_drift, std::abs(s.energy().total() / energy - 1));
    impulse_drift = std::max(impulse_drift, (momentum(s) - impulse).norm() / impulse.norm());
  };
  run_to_end(s, watch);
  const auto check = [&](const char* quantity, double error, double allowed, std::string (*text)(double)) {
    expect({"rotation", drifting, quantity, "conservation", metres(0.1)}, error, allowed, text);
  };
  check("momentum of a free block over three turns, consistent form", impulse_drift, 1e-14, scientific);
  check("angular momentum of a free block over three turns, consistent form", spin_drift, 1e-14, scientific);
  check("energy of a free block over three turns, consistent form", energy_drift, 3e-4, percent);
}
