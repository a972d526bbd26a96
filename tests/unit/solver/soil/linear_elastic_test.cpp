#include "solver/soil/linear_elastic.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace porosph;

namespace {

const double youngs_modulus = 15e6, poissons_ratio = 0.33;
const LinearElastic soil = LinearElastic::from_young(youngs_modulus, poissons_ratio);
LinearElastic::History none;
const Mat2 some_gradient = (Mat2() << 0.3, -0.8, 0.5, -0.7).finished();

Eigen::Matrix3d tensor(const Stress& s) {
  Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
  t << s.xx, s.xy, 0, s.xy, s.yy, 0, 0, 0, s.zz;
  return t;
}

Eigen::Matrix3d in_space(const Mat2& m) {
  Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
  t.topLeftCorner<2, 2>() = m;
  return t;
}

}  // namespace

TEST_CASE("the moduli are those of Young's modulus and Poisson's ratio", "[soil]") {
  CHECK(soil.shear_modulus == Approx(youngs_modulus / 2.66));
  CHECK(soil.bulk_modulus == Approx(youngs_modulus / 1.02));
  CHECK(soil.constrained_modulus() ==
        Approx(youngs_modulus * (1 - poissons_ratio) / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio))));
}

TEST_CASE("the stress rate obeys the generalised Hooke's law, eqs. (26) to (28)", "[soil]") {
  const Eigen::Matrix3d strain = in_space(0.5 * (some_gradient + some_gradient.transpose()));
  const Eigen::Matrix3d rate = tensor(soil.elastic_rate(strain.topLeftCorner<2, 2>()));
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d deviator = rate - rate.trace() / 3 * one;
  const Eigen::Matrix3d back = deviator / (2 * soil.shear_modulus) + (1 - 2 * poissons_ratio) /
                                                                         (3 * youngs_modulus) * rate.trace() *
                                                                         one;  // eq. (26)
  CHECK((back - strain).norm() < 1e-15);
  const Eigen::Matrix3d forward = 2 * soil.shear_modulus * (strain - strain.trace() / 3 * one) +
                                  soil.bulk_modulus * strain.trace() * one;  // eq. (28)
  CHECK((forward - rate).norm() < 1e-14 * rate.norm());
}

TEST_CASE("a small step is the Jaumann rate of eq. (30)", "[soil]") {
  const Stress old{-3e6, 1e6, -2e6, 4e6};
  const Eigen::Matrix3d s = tensor(old), d = in_space(0.5 * (some_gradient + some_gradient.transpose())),
                        w = in_space(0.5 *
                                     (some_gradient - some_gradient.transpose()));  // omega_xy of eq. (31)
  Eigen::Matrix3d rate = 2 * soil.shear_modulus * (d - d.trace() / 3 * Eigen::Matrix3d::Identity()) +
                         soil.bulk_modulus * d.trace() * Eigen::Matrix3d::Identity();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) rate(a, b) += s(a, c) * w(b, c) + s(c, b) * w(a, c);
  const double dt = 1e-6;
  const Eigen::Matrix3d quotient = (tensor(soil.step(old, Gradient(some_gradient), dt, none)) - s) / dt;
  CHECK((quotient - rate).norm() < 1e-5 * rate.norm());
}

TEST_CASE("a rigid rotation turns the stress and nothing else", "[soil]") {
  const double step = 0.3;                     // [rad]
  const double spin = 2 * std::tan(step / 2);  // mid-step gradient of that rotation, dt = 1
  const Mat2 gradient = (Mat2() << 0, -spin, spin, 0).finished();
  const Stress old{-3e4, 1e4, -2e4, 4e4};
  const Mat2 turn = (Mat2() << std::cos(step), -std::sin(step), std::sin(step), std::cos(step)).finished();
  const Stress now = soil.step(old, Gradient(gradient), 1, none);
  CHECK((now.in_plane() - turn * old.in_plane() * turn.transpose()).norm() < 1e-9);
  CHECK(now.zz == old.zz);
}

// Dienes (1979): shear stress G sin(gamma) and normal stresses +-G (1 - cos(gamma)) by Jaumann's rate. What a
// step adds is not turned by half of the step's rotation, so that the law is of first order here.
TEST_CASE("simple shear by several hundred percent has Dienes' stress", "[soil]") {
  constexpr double shear = 4;
  const double g = soil.shear_modulus, along = g * (1 - std::cos(shear)), across = g * std::sin(shear);
  const Mat2 gradient = (Mat2() << 0, shear, 0, 0).finished(),
             exact = (Mat2() << along, across, across, -along).finished();
  const auto sheared_in = [&](int steps) {
    Stress now{0, 0, 0, 0};
    for (int k = 0; k < steps; ++k) now = soil.step(now, Gradient(gradient), 1.0 / steps, none);
    CHECK(now.zz == Approx(0).margin(1e-9 * g));
    return now.in_plane();
  };
  const Mat2 coarse = sheared_in(200), fine = sheared_in(400);
  CHECK((fine - exact).norm() < 0.51 * (coarse - exact).norm());
  CHECK((2 * fine - coarse - exact).norm() < 1e-3 * g);
}
