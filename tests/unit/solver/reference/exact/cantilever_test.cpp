#include "solver/reference/exact/cantilever.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

using namespace porosph;

namespace {

Cantilever plate_of(double thickness) { return {0.2, thickness, 2e6, 0.4, 1000}; }

/// Lowest frequency of the same beam by linear elements in deflection and rotation, shear integrated at
/// mid-element.
double finite_elements(const Cantilever& plate, int elements) {
  const double e = plate.length / elements, d = plate.thickness;
  const double nu = plate.poissons_ratio;
  const double shear = 5 / (6 - nu) * plate.youngs_modulus / (2 * (1 + nu)) * d;
  const double bending = plate.youngs_modulus / (1 - nu * nu) * d * d * d / 12;
  const Eigen::Vector4d gamma(-1 / e, -0.5, 1 / e, -0.5), curvature(0, -1 / e, 0, 1 / e);
  const Eigen::Matrix4d stiffness =
      e * (shear * gamma * gamma.transpose() + bending * curvature * curvature.transpose());
  Eigen::Matrix4d mass = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = i % 2; j < 4; j += 2)
      mass(i, j) = plate.density * e * (i % 2 ? d * d * d / 12 : d) * (i == j ? 2 : 1) / 6;
  const int n = 2 * (elements + 1);
  Eigen::MatrixXd all_stiffness = Eigen::MatrixXd::Zero(n, n), all_mass = all_stiffness;
  for (int i = 0; i < elements; ++i) {
    all_stiffness.block<4, 4>(2 * i, 2 * i) += stiffness;
    all_mass.block<4, 4>(2 * i, 2 * i) += mass;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      all_stiffness.bottomRightCorner(n - 2, n - 2), all_mass.bottomRightCorner(n - 2, n - 2),
      Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues()[0]);
}

}  // namespace

TEST_CASE("the thin plate has Landau and Lifshitz' frequency") {
  const double d = 0.02;
  const double expected = 3.516015 / (0.2 * 0.2) * std::sqrt(2e6 * d * d / (12 * 1000 * (1 - 0.16)));
  CHECK(thin_plate_frequency(plate_of(d)) == Approx(expected).epsilon(1e-6));
}

TEST_CASE("thick plates agree with finite elements of the same theory") {
  for (const double d : {0.01, 0.04, 0.1, 0.2})
    CHECK(thick_plate_frequency(plate_of(d)) == Approx(finite_elements(plate_of(d), 100)).epsilon(5e-4));
}

TEST_CASE("thickness lowers the frequency, by its square at first") {
  const auto lowered = [](double d) {
    return 1 - thick_plate_frequency(plate_of(d)) / thin_plate_frequency(plate_of(d));
  };
  CHECK(lowered(0.0002) == Approx(0).margin(1e-5));
  CHECK(lowered(0.01) > 0);
  CHECK(lowered(0.01) / lowered(0.005) == Approx(4).epsilon(0.02));
}

TEST_CASE("shapes are clamped at one end, scaled to one and free at the other") {
  const Cantilever plate = plate_of(0.04);
  for (const auto shape : {thin_plate_shape, thick_plate_shape}) {
    CHECK(shape(plate, 0).deflection == Approx(0).margin(1e-14));
    CHECK(shape(plate, 0).rotation == Approx(0).margin(1e-12));
    CHECK(shape(plate, 0.2).deflection == Approx(1));
    const double moment = (shape(plate, 0.2).rotation - shape(plate, 0.2 - 1e-5).rotation) / 1e-5;
    CHECK(moment == Approx(0).margin(1e-2));
  }
  // no shear strain in the thin plate; none at the free end of the thick one, but at its clamp
  const auto slope = [&](auto shape, double x) {
    return (shape(plate, x + 1e-6).deflection - shape(plate, x - 1e-6).deflection) / 2e-6;
  };
  CHECK(thin_plate_shape(plate, 0.1).rotation == Approx(slope(thin_plate_shape, 0.1)).epsilon(1e-6));
  CHECK(thick_plate_shape(plate, 0.2).rotation == Approx(slope(thick_plate_shape, 0.2)).epsilon(1e-6));
  CHECK(slope(thick_plate_shape, 1e-6) > 0.1);
}

TEST_CASE("the thin plate's shape is the benchmark's formula") {
  const double kl = 1.875104068711961, k = kl / 0.2;
  const auto f = [&](double x) {
    return (std::cos(kl) + std::cosh(kl)) * (std::cosh(k * x) - std::cos(k * x)) +
           (std::sin(kl) - std::sinh(kl)) * (std::sinh(k * x) - std::sin(k * x));
  };
  for (const double x : {0.03, 0.1, 0.17})
    CHECK(thin_plate_shape(plate_of(0.02), x).deflection == Approx(f(x) / f(0.2)).epsilon(1e-10));
}

TEST_CASE("the mode's kinetic energy is its elastic energy half a swing later") {
  const Cantilever plate = plate_of(0.05);
  const double omega = thick_plate_frequency(plate), d = plate.thickness, nu = plate.poissons_ratio;
  const double shear = 5 / (6 - nu) * plate.youngs_modulus / (2 * (1 + nu)) * d;
  const double bending = plate.youngs_modulus / (1 - nu * nu) * d * d * d / 12;
  double kinetic = 0, elastic = 0;
  const int cells = 2000;
  for (int i = 0; i < cells; ++i) {
    const double half = 0.1 / cells, x = (2 * i + 1) * half;
    const BendingShape here = thick_plate_shape(plate, x);
    const BendingShape left = thick_plate_shape(plate, x - half), right = thick_plate_shape(plate, x + half);
    const double strain = (right.deflection - left.deflection) / (2 * half) - here.rotation;
    const double curvature = (right.rotation - left.rotation) / (2 * half);
    kinetic += plate.density * omega * omega *
               (d * here.deflection * here.deflection + d * d * d / 12 * here.rotation * here.rotation);
    elastic += shear * strain * strain + bending * curvature * curvature;
  }
  CHECK(kinetic == Approx(elastic).epsilon(1e-5));
}

TEST_CASE("what is not a plate is refused") {
  CHECK_THROWS_AS(thick_plate_frequency(plate_of(0.3)), std::invalid_argument);
  CHECK_THROWS_AS(thin_plate_frequency(plate_of(0)), std::invalid_argument);
}
