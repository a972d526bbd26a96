// A layer of soil that slides down a fixed base: what the base bears.
#include <catch2/catch.hpp>

#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"
#include "tests/verification/verification.hpp"

using namespace porosph;

namespace {

constexpr double radian = std::numbers::pi / 180, friction = 19.8, tilt = 25;

/// A layer of 1 m on a level base; gravity leans instead.
Model layer(int rows, Case& scene) {
  constexpr double spacing = 0.01;
  const double depth = rows * spacing;
  scene = box_of_soil(100, rows, spacing);
  SoilCase& soil = scene.soils[0];
  soil.youngs_modulus = 0.84e6, soil.poissons_ratio = 0.3;
  soil.unit_weight_saturated = soil.unit_weight_unsaturated = 20.4e3;
  soil.law = LawKind::drucker_prager;
  soil.strength.friction_angle = friction;
  add_wall(scene, BoundaryKind::fixed, {-0.2, 0}, {2, 0});
  scene.formulation = default_formulation(Motion::consistent);
  scene.formulation.zero_energy_control = 0.1;
  Model model = build_model(scene);
  const double g = scene.loading.gravity;
  model.gravity = g * Vec2(std::sin(tilt * radian), -std::cos(tilt * radian));
  Particles& p = model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double weight = p.density[a] * g * std::cos(tilt * radian) * (depth - p.position[a].y());
    p.stress[a] = {-weight, -weight, -weight, 0};
  }
  return model;
}

}  // namespace

TEST_CASE("the base under a sliding layer bears sin phi of the pressure on it", "[collapse]") {
  const int rows = GENERATE(2, 3, 5);
  Case scene;
  Model model = layer(rows, scene);
  const auto dynamics = make_dynamics(scene.formulation, model);
  Particles& p = model.particles;
  const double dt = 0.8 * model.smoothing_length / model.wave_speed;
  const int steps = static_cast<int>(0.2 / dt);
  std::vector<Vec2> a(p.size());
  double shear = 0, pressure = 0;
  for (int k = 0; k < steps; ++k) {
    dynamics->prepare();
    dynamics->accelerations(a);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.velocity[i] += (k == 0 ? 0.5 : 1) * dt * a[i];
      p.position[i] += dt * p.velocity[i];
    }
    dynamics->strain(dt);
    if (k * dt < 0.05) continue;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (std::abs(p.start[i].x() - 0.5) < 0.1 && p.start[i].y() < model.spacing)
        shear += std::abs(p.stress[i].xy), pressure -= p.stress[i].yy;
  }
  // Flow without dilation at constant volume shears on the plane of largest shear stress: not tan phi.
  CHECK(shear / pressure == Approx(std::sin(friction * radian)).epsilon(0.005));
}
