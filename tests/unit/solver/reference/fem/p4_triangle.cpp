#include "solver/reference/fem/p4_triangle.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace porosph::p4;

TEST_CASE("P4 shape functions are 1 at their own node and 0 at the others") {
  for (int i = 0; i < node_count; ++i) {
    const Values n = values(nodes()[i]);
    for (int j = 0; j < node_count; ++j) CHECK(n[j] == Approx(i == j ? 1 : 0).margin(1e-14));
  }
}

TEST_CASE("P4 shape functions reproduce every polynomial of degree 4 and its gradient") {
  const Barycentric at(0.21, 0.47, 0.32);
  const Values n = values(at);
  const Gradients g = gradients(at);
  for (int a = 0; a <= 4; ++a)
    for (int b = 0; a + b <= 4; ++b) {
      double value = 0;
      Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
      for (int i = 0; i < node_count; ++i) {
        const double at_node = std::pow(nodes()[i][1], a) * std::pow(nodes()[i][2], b);
        value += at_node * n[i];
        gradient += at_node * g.col(i);
      }
      const double x = at[1], y = at[2];
      CHECK(value == Approx(std::pow(x, a) * std::pow(y, b)).margin(1e-14));
      CHECK(gradient.x() == Approx(a == 0 ? 0 : a * std::pow(x, a - 1) * std::pow(y, b)).margin(1e-13));
      CHECK(gradient.y() == Approx(b == 0 ? 0 : b * std::pow(x, a) * std::pow(y, b - 1)).margin(1e-13));
    }
}

TEST_CASE("The P4 quadrature integrates every monomial up to degree 6") {
  for (int a = 0; a <= 6; ++a)
    for (int b = 0; a + b <= 6; ++b)
      for (int c = 0; a + b + c <= 6; ++c) {
        double mean = 0;
        for (const auto& q : quadrature())
          mean += q.weight * std::pow(q.at[0], a) * std::pow(q.at[1], b) * std::pow(q.at[2], c);
        const double exact =
            2 * std::tgamma(a + 1) * std::tgamma(b + 1) * std::tgamma(c + 1) / std::tgamma(a + b + c + 3);
        CHECK(mean == Approx(exact).epsilon(1e-12));
      }
}
