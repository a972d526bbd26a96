#include "solver/reference/fem/p4_triangle.hpp"

namespace porosph::p4 {
namespace {

/// Multiples of 1/4 that make up the nodes' barycentric coordinates, in the order that nodes() states.
constexpr std::array<std::array<int, 3>, node_count> quarters{{{4, 0, 0},
                                                               {0, 4, 0},
                                                               {0, 0, 4},
                                                               {3, 1, 0},
                                                               {2, 2, 0},
                                                               {1, 3, 0},
                                                               {0, 3, 1},
                                                               {0, 2, 2},
                                                               {0, 1, 3},
                                                               {1, 0, 3},
                                                               {2, 0, 2},
                                                               {3, 0, 1},
                                                               {2, 1, 1},
                                                               {1, 2, 1},
                                                               {1, 1, 2}}};

struct Factor {
  double value, derivative;
};

/// The polynomial of degree m in l that is 1 at l = m/4 and 0 at l = 0, 1/4, ... (m-1)/4.
Factor silvester(int m, double l) {
  Factor p{1, 0};
  for (int s = 0; s < m; ++s) {
    const double f = (order * l - s) / (s + 1), df = static_cast<double>(order) / (s + 1);
    p = {p.value * f, p.derivative * f + p.value * df};
  }
  return p;
}

}  // namespace

const std::array<Barycentric, node_count>& nodes() {
  static const auto all = [] {
    std::array<Barycentric, node_count> at;
    for (int i = 0; i < node_count; ++i)
      at[i] = Barycentric(quarters[i][0], quarters[i][1], quarters[i][2]) / order;
    return at;
  }();
  return all;
}

Values values(const Barycentric& at) {
  Values n;
  for (int i = 0; i < node_count; ++i) {
    const auto& q = quarters[i];
    n[i] = silvester(q[0], at[0]).value * silvester(q[1], at[1]).value * silvester(q[2], at[2]).value;
  }
  return n;
}

Gradients gradients(const Barycentric& at) {
  Gradients g;
  for (int i = 0; i < node_count; ++i) {
    const auto& q = quarters[i];
    const Factor a = silvester(q[0], at[0]), b = silvester(q[1], at[1]), c = silvester(q[2], at[2]);
    const double along_l0 = a.derivative * b.value * c.value;
    g(0, i) = a.value * b.derivative * c.value - along_l0;
    g(1, i) = a.value * b.value * c.derivative - along_l0;
  }
  return g;
}

const std::array<QuadraturePoint, 12>& quadrature() {
  static const auto all = [] {
    std::array<QuadraturePoint, 12> points;
    int n = 0;
    const auto three = [&](double weight, double l) {
      for (int i = 0; i < 3; ++i) {
        Barycentric at = Barycentric::Constant(l);
        at[i] = 1 - 2 * l;
        points[n++] = {at, weight};
      }
    };
    three(0.116786275726379, 0.249286745170910);
    three(0.050844906370207, 0.063089014491502);
    const double a = 0.053145049844817, b = 0.310352451033784, c = 1 - a - b;
    for (const Barycentric& at : {Barycentric(a, b, c), Barycentric(b, c, a), Barycentric(c, a, b),
                                  Barycentric(a, c, b), Barycentric(c, b, a), Barycentric(b, a, c)})
      points[n++] = {at, 0.082851075618374};
    return points;
  }();
  return all;
}

}  // namespace porosph::p4
