// The beam that sheets are: exact at its nodes.
#include "solver/run/beam.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/box_of_soil.hpp"

using namespace porosph;

namespace {

constexpr double length = 3, bending = 7e6, axial = 4e7;

/// Clamped at its beginning.
std::vector<double> deformed(const Beam& beam, std::vector<double> forces) {
  BandMatrix matrix(beam.size());
  beam.add_stiffness(1, matrix);
  for (std::size_t i = 0; i < 3; ++i) matrix.hold(i), forces[i] = 0;
  matrix.solve(forces);
  return forces;
}

}  // namespace

TEST_CASE("a band matrix solves as a full one does", "[sheet]") {
  constexpr std::size_t n = 17;
  Noise noise(3);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  BandMatrix band(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i < 5 ? 0 : i - 5; j <= i; ++j) {
      const double value = i == j ? 12 : noise();
      full(i, j) += value, band.add(i, j, value);
      if (i != j) full(j, i) += value;
    }
  std::vector<double> x(n);
  for (double& value : x) value = noise();
  const Eigen::VectorXd expected = full.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(x.data(), n));
  band.solve(x);
  for (std::size_t i = 0; i < n; ++i) CHECK(x[i] == Approx(expected[i]).epsilon(1e-12));
}

TEST_CASE("a cantilever beam bends as Euler and Bernoulli say", "[sheet]") {
  const std::size_t elements = GENERATE(1, 4, 7);
  const Beam beam(length, elements, bending, axial, 1);
  const double load = 2e4, pull = 3e4, at = 1.3, force = 5e4;
  const std::vector<Vec2> spread(elements, {pull, load});
  const Beam::PointForce point{beam.place(at), {0, force}};
  std::vector<double> forces(beam.size(), 0);
  beam.add_spread(spread, forces);
  Beam::add_force(point.at, point.force, forces);
  const std::vector<double> q = deformed(beam, forces);
  const double expected =
      load * std::pow(length, 4) / (8 * bending) + force * at * at * (3 * length - at) / (6 * bending);
  CHECK(q[q.size() - 2] == Approx(expected).epsilon(1e-9));
  CHECK(q[q.size() - 3] == Approx(pull * length * length / (2 * axial)).epsilon(1e-9));
  const auto sections = beam.sections(q, {point}, spread);
  for (std::size_t i = 0; i < beam.nodes(); ++i) {
    const double s = length * static_cast<double>(i) / static_cast<double>(elements), rest = length - s;
    CHECK(sections[i].moment ==
          Approx(load * rest * rest / 2 + force * std::max(0.0, at - s)).margin(1e-9 * load));
    CHECK(sections[i].shear == Approx(-load * rest - (s < at ? force : 0)).margin(1e-9 * load));
    CHECK(sections[i].axial == Approx(pull * rest).margin(1e-9 * pull));
  }
}
