#include <catch2/catch.hpp>

#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

/// Accelerations of an unstressed, weightless, free body under `pressure` [Pa] at a position.
template <class Pressure>
std::vector<Vec2> accelerations(Motion motion, Model& model, Pressure pressure) {
  model.gravity = Vec2::Zero();
  Particles& p = model.particles;
  for (std::size_t a = 0; a < p.size(); ++a) p.pore_pressure[a] = pressure(p.position[a]);
  const auto dynamics = make_dynamics({.motion = motion}, model);
  std::vector<Vec2> found(p.size());
  dynamics->prepare();
  dynamics->accelerations(found);
  return found;
}

Model disordered_body() {
  Case scene = box_of_soil(10, 10);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.2;
  return build_model(scene);
}

double largest(const std::vector<Vec2>& field) {
  double norm = 0;
  for (const Vec2& v : field) norm = std::max(norm, v.norm());
  return norm;
}

}  // namespace

TEST_CASE("constant pore pressure moves nothing, but for the conventional form", "[motion]") {
  Model model = disordered_body();
  const auto constant = [](const Vec2&) { return -5e4; };
  CHECK(largest(accelerations(Motion::proposed, model, constant)) < 1e-10);
  CHECK(largest(accelerations(Motion::rho_squared, model, constant)) < 1e-10);
  CHECK(largest(accelerations(Motion::consistent, model, constant)) < 1e-10);
  CHECK(largest(accelerations(Motion::conventional, model, constant)) > 10);
}

TEST_CASE("the conventional form pulls the surface outwards and leaves the inside alone", "[motion]") {
  Model model = build_model(box_of_soil(12, 12));
  const auto a = accelerations(Motion::conventional, model, [](const Vec2&) { return -5e4; });
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 from_centre = model.particles.position[i] - Vec2(3, 3);
    const double to_surface = 3 - from_centre.lpNorm<Eigen::Infinity>();
    if (to_surface > 1.3) CHECK(a[i].norm() < 1e-10);
    if (to_surface < 0.3) CHECK(a[i].dot(from_centre) > 0);
  }
}

TEST_CASE("hydrostatic pore pressure is a buoyancy, exact on any particles", "[motion]") {
  Model model = disordered_body();
  const auto motion = GENERATE(Motion::proposed, Motion::rho_squared, Motion::consistent);
  const auto a = accelerations(motion, model, [](const Vec2& x) { return -9810 * (8 - x.y()); });
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK((a[i] - Vec2(0, 9810 / model.particles.density[i])).norm() < 1e-10);
}

TEST_CASE("water that ends at a wall continues behind it", "[motion]") {
  Case scene = box_of_soil(8, 6);
  hold_as_column(scene, GENERATE(BoundaryKind::fixed, BoundaryKind::roller));
  scene.formulation.motion = GENERATE(Motion::conventional, Motion::proposed, Motion::consistent);
  const auto accelerations = [&](const WaterStretch& stretch) {
    scene.water.stretches = {stretch};
    Model model = build_model(scene);
    const auto dynamics = make_dynamics(scene.formulation, model);
    std::vector<Vec2> found(model.particles.size());
    dynamics->prepare();
    dynamics->accelerations(found);
    return found;
  };
  const auto endless = accelerations({.level = 8}), over_the_soil = accelerations({0, 4, 8});
  for (std::size_t a = 0; a < endless.size(); ++a) CHECK((endless[a] - over_the_soil[a]).norm() < 1e-10);
}
