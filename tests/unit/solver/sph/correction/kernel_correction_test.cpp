#include "solver/sph/correction/kernel_correction.hpp"

#include <catch2/catch.hpp>

#include "solver/sph/dynamics.hpp"
#include "tests/box_of_soil.hpp"

using namespace porosph;

TEST_CASE("the correction makes the gradient of a linear field exact", "[correction]") {
  Noise noise(11);
  const Vec2 slope(3, -7);
  Mat2 sum = Mat2::Zero();
  Vec2 gradient = Vec2::Zero();
  for (int b = 0; b < 15; ++b) {
    const Vec2 to_b = noise.vector();
    const Vec2 g = (1.2 + noise()) * to_b;
    sum += g * to_b.transpose();
    gradient += slope.dot(to_b) * g;
  }
  CHECK((correction_matrix(sum) * gradient - slope).norm() < 1e-12);
}

TEST_CASE("the correction stays bounded where the neighbours do not span the plane", "[correction]") {
  const auto largest = [](const Mat2& m) { return Eigen::JacobiSVD<Mat2>(m).singularValues()[0]; };
  CHECK(largest(correction_matrix(Mat2(Mat2::Zero()))) ==
        Approx(1 / 0.3));  // a lone particle, whose gradients are zero
  const Vec2 row = Vec2(1, 2) / std::sqrt(5.0);
  const Mat2 along = row * row.transpose();
  CHECK((correction_matrix(along) * row - row).norm() < 1e-14);  // exact along a row of particles
  CHECK(largest(correction_matrix(along)) == Approx(10));
  Noise noise(3);
  for (int i = 0; i < 100; ++i) {
    const Vec2 direction = noise.vector().normalized();
    const Mat2 sum = 0.01 * (1 + noise()) * Mat2::Identity() + direction * direction.transpose();
    CHECK(largest(correction_matrix(sum)) <= Approx(10));
    CHECK((correction_matrix(sum) * sum * direction - direction).norm() < 1e-12);
  }
}

TEST_CASE("every motion equation sees a linear velocity exactly, at free surfaces too", "[correction]") {
  Case scene = box_of_soil(10, 8);
  scene.particles.arrangement = Arrangement::disordered;
  scene.particles.disorder = 0.3;
  scene.formulation.motion =
      GENERATE(Motion::conventional, Motion::proposed, Motion::rho_squared, Motion::consistent);
  Model model = build_model(scene);
  const Mat2 gradient = (Mat2() << 0.3, -0.8, 0.5, -0.7).finished();
  for (std::size_t a = 0; a < model.particles.size(); ++a)
    model.particles.velocity[a] = Vec2(4, -2) + gradient * model.particles.position[a];
  const auto dynamics = make_dynamics(scene.formulation, model);
  std::vector<Mat2> found(model.particles.size());
  dynamics->prepare();
  dynamics->velocity_gradients(found);
  for (const Mat2& m : found) CHECK((m - gradient).norm() < 1e-12);
}
