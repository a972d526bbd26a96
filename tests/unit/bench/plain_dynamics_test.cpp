#include "app/bench/plain_dynamics.hpp"

#include <omp.h>

#include <catch2/catch.hpp>

#include "tests/box_of_soil.hpp"
#include "tests/step_by_hand.hpp"

using namespace porosph;

namespace {

/// Two layers of disordered particles under water, between rollers on fixed ground or in a fixed trough.
Case scene(bool trough) {
  Case c = box_of_soil(8, 3);
  c.particles.arrangement = Arrangement::disordered;
  c.particles.disorder = 0.2;
  c.soils.push_back(c.soils[0]);
  c.soils[1].name = "upper";
  c.soils[1].polygon = box_outline(0, 1.5, 4, 3);
  c.soils[1].youngs_modulus = 4e6;
  add_water(c, 2.2);
  if (trough) {
    add_wall(c, BoundaryKind::fixed, {0, 0}, {4, 0});
    add_wall(c, BoundaryKind::fixed, {0, 0}, {0, 3});
    add_wall(c, BoundaryKind::fixed, {4, 0}, {4, 3});
  } else {
    hold_as_column(c);
  }
  return c;
}

FormulationCase proposed() {
  FormulationCase f{.motion = Motion::proposed};
  f.artificial_viscosity_alpha = 0.1;
  f.artificial_viscosity_beta = 0.2;
  return f;
}

void stir(Particles& p) {
  Noise noise(7);
  for (std::size_t a = 0; a < p.size(); ++a) {
    p.velocity[a] = noise.vector();
    p.stress[a] = {1e5 * noise(), 1e5 * noise(), 1e5 * noise(), 1e5 * noise()};
    p.density[a] *= 1 + 0.05 * noise();
  }
}

/// Accelerations after steps in which neighbours change.
std::vector<Vec2> stepped(Dynamics& dynamics, Model& model) {
  step_by_hand(dynamics, model, 1e-3, 40);
  std::vector<Vec2> acceleration(model.particles.size());
  dynamics.prepare();
  dynamics.accelerations(acceleration);
  return acceleration;
}

}  // namespace

TEST_CASE("The plain loops compute what the solver's proposed form does") {
  omp_set_num_threads(1);  // a box as small as this is not worth a second one
  const bool trough = GENERATE(false, true);
  FormulationCase formulation = proposed();
  formulation.kernel_correction = GENERATE(true, false);
  CAPTURE(trough, formulation.kernel_correction);
  Model fast_model = build_model(scene(trough));
  stir(fast_model.particles);
  Model plain_model = fast_model;
  const auto fast = make_dynamics(formulation, fast_model);
  bench::PlainDynamics plain(formulation, plain_model);
  const std::vector<Vec2> a = stepped(*fast, fast_model), b = stepped(plain, plain_model);
  std::vector<Mat2> fast_gradients(a.size()), plain_gradients(a.size());
  fast->velocity_gradients(fast_gradients);
  plain.velocity_gradients(plain_gradients);
  double largest = 0, steepest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, b[i].norm());
    steepest = std::max(steepest, plain_gradients[i].norm());
  }
  REQUIRE(largest > 9.81);
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK((a[i] - b[i]).norm() < 1e-10 * largest);
    CHECK((fast_gradients[i] - plain_gradients[i]).norm() < 1e-10 * steepest);
  }
  CHECK(plain.counts.searches > 1);
  CHECK(plain.counts.refreshes == 41);
}

TEST_CASE("The plain loops refuse what they do not know") {
  Model model = build_model(scene(false));
  CHECK_THROWS_AS(bench::PlainDynamics({.motion = Motion::consistent}, model), std::invalid_argument);
  FormulationCase stressed = proposed();
  stressed.artificial_stress = 0.5;
  CHECK_THROWS_AS(bench::PlainDynamics(stressed, model), std::invalid_argument);
}
