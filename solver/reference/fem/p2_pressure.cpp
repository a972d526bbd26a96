#include "solver/reference/fem/p2_pressure.hpp"

namespace porosph::p2 {

Values values(const p4::Barycentric& l) {
  Values n;
  for (int i = 0; i < 3; ++i) {
    n[i] = l[i] * (2 * l[i] - 1);
    n[3 + i] = 4 * l[i] * l[(i + 1) % 3];
  }
  return n;
}

Gradients gradients(const p4::Barycentric& l) {
  Eigen::Matrix<double, 3, node_count> g = Eigen::Matrix<double, 3, node_count>::Zero();  // d/d(l0, l1, l2)
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    g(i, i) = 4 * l[i] - 1;
    g(i, 3 + i) = 4 * l[next], g(next, 3 + i) = 4 * l[i];
  }
  return g.bottomRows<2>().rowwise() - g.row(0);
}

}  // namespace porosph::p2
