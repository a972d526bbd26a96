#include "solver/sph/kernel/cubic_spline.hpp"

#include <catch2/catch.hpp>

using namespace porosph;

namespace {

/// Integral of W over all of space, by Simpson's rule in r, which is exact for the square shells' cubic
/// pieces to 1e-12.
template <int dim>
double integral(const CubicSpline<dim>& kernel) {
  const auto shell = [&](double r) {
    return kernel.value(r) * (dim == 2 ? 2 * std::numbers::pi * r : 4 * std::numbers::pi * r * r);
  };
  const int pieces = 2000;
  const double d = kernel.support() / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i)
    sum += d / 6 * (shell(i * d) + 4 * shell((i + 0.5) * d) + shell((i + 1) * d));
  return sum;
}

}  // namespace

TEST_CASE("the kernel's integral is one", "[kernel]") {
  const double h = GENERATE(0.24, 3.0);
  CHECK(integral(CubicSpline<2>(h)) == Approx(1).epsilon(1e-10));
  CHECK(integral(CubicSpline<3>(h)) == Approx(1).epsilon(1e-10));
}

TEST_CASE("the kernel's slope is its derivative over the distance", "[kernel]") {
  const CubicSpline<2> kernel(0.24);
  const double d = 1e-6;
  for (double r = 0.01; r < 0.6; r += 0.0137) {
    const double derivative = (kernel.value(r + d) - kernel.value(r - d)) / (2 * d);
    CHECK(kernel.slope(r) == Approx(derivative / r).epsilon(1e-6).margin(1e-5));
  }
  CHECK(kernel.slope(0) == Approx(-3 * kernel.alpha / (0.24 * 0.24)));
}

TEST_CASE("the kernel ends at its support", "[kernel]") {
  const CubicSpline<2> kernel(0.24);
  CHECK(kernel.support() == 0.48);
  CHECK(kernel.value(0.48) == 0);
  CHECK(kernel.slope(0.48) == 0);
  CHECK(kernel.slope(7) == 0);
  CHECK(kernel.value(0.4799) > 0);
}
