#include "solver/water/flow/sparse_rows.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace porosph;

namespace {

/// -d2/dx2 + drift d/dx on a line, with a diagonal that varies.
SparseRows line(int n, double drift) {
  SparseRows a;
  for (int i = 0; i < n; ++i) {
    if (i > 0) a.column.push_back(i - 1), a.value.push_back(-1 - drift);
    if (i + 1 < n) a.column.push_back(i + 1), a.value.push_back(-1 + drift);
    a.diagonal.push_back(2.01 + 0.5 * std::sin(i));
    a.begin.push_back(static_cast<std::int32_t>(a.column.size()));
  }
  return a;
}

double error(const SparseRows& a, const std::vector<double>& b, const std::vector<double>& x) {
  std::vector<double> image(x.size());
  a.multiply(x, image);
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(image[i] - b[i]));
  return worst;
}

}  // namespace

TEST_CASE("conjugate gradients and BiCGSTAB leave the residual that was asked for", "[water]") {
  const int n = GENERATE(1, 7, 500);
  std::vector<double> b(n, 1);
  b[0] = -3;
  std::vector<double> x(n, 0), y(n, 0);
  const SparseRows symmetric = line(n, 0), drifting = line(n, 0.4);
  const KrylovResult by_cg = conjugate_gradients(symmetric, b, x, 1e-12, 2000);
  const KrylovResult by_bicgstab = bicgstab(drifting, b, y, 1e-12, 2000);
  CHECK(by_cg.converged);
  CHECK(by_bicgstab.converged);
  CHECK(error(symmetric, b, x) < 1e-10);
  CHECK(error(drifting, b, y) < 1e-10);
  CHECK(conjugate_gradients(symmetric, b, x, 1e-3, 2000).iterations <= 2000);
}

TEST_CASE("conjugate gradients stop where a matrix is not positive", "[water]") {
  SparseRows a = line(10, 0);
  for (double& d : a.diagonal) d = -d;
  std::vector<double> b(10, 1), x(10, 0);
  CHECK_FALSE(conjugate_gradients(a, b, x, 1e-8, 100).converged);
}
