#include "solver/reference/exact/consolidation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/reference/exact/root.hpp"

namespace porosph {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int many = 400;  // terms: times from T = 1e-4 on

/// Sums term(root, sign) exp(-root^2 T) over the roots (2m + 1) pi / 2.
template <class Term>
double layer_series(double factor, Term&& term) {
  double sum = 0;
  for (int m = 0; m < many; ++m) {
    const double root = (2 * m + 1) * pi / 2;
    sum += term(root, m % 2 == 0 ? 1 : -1) * std::exp(-root * root * factor);
  }
  return sum;
}

/// atan(ratio tan(angle)) without jumps.
double turned(double angle, double ratio) {
  const double whole = std::round(angle / pi) * pi, rest = angle - whole;
  return whole + std::atan2(ratio * std::sin(rest), std::cos(rest));
}

}  // namespace

double terzaghi_pressure(double depth, double factor) {
  return layer_series(factor, [&](double m, int) { return 2 / m * std::sin(m * depth); });
}
double terzaghi_degree(double factor) {
  return 1 - layer_series(factor, [](double m, int) { return 2 / (m * m); });
}
double own_weight_pressure(double depth, double factor) {
  return layer_series(factor, [&](double m, int sign) { return sign * 2 / (m * m) * std::sin(m * depth); });
}
double own_weight_degree(double factor) {
  return 1 - layer_series(factor, [](double m, int sign) { return sign * 4 / (m * m * m); });
}

/// With a = lambda h1 / sqrt c1 and b = lambda h2 / sqrt c2, pressure and flow are continuous where
/// cos a cos b = r sin a sin b, r = k2 sqrt c1 / (k1 sqrt c2): atan(r tan a) + b = pi/2 + n pi, which grows
/// with lambda.
TwoLayers::TwoLayers(const Layer& upper, const Layer& lower, double unit_weight)
    : upper_(upper),
      lower_(lower),
      root_c1_(std::sqrt(upper.permeability * upper.modulus / unit_weight)),
      root_c2_(std::sqrt(lower.permeability * lower.modulus / unit_weight)) {
  const double ratio = lower.permeability * root_c1_ / (upper.permeability * root_c2_);
  const double of_a = upper.thickness / root_c1_, of_b = lower.thickness / root_c2_;
  for (int n = 0; n < many; ++n) {
    const double wanted = (n + 0.5) * pi;
    const double lambda =
        find_root([&](double l) { return turned(l * of_a, ratio) + l * of_b - wanted; },
                  std::max(0.0, wanted - 0.5 * pi) / (of_a + of_b), (wanted + 0.5 * pi) / (of_a + of_b));
    const double a = lambda * of_a, b = lambda * of_b, joint = std::sin(a) / std::cos(b);
    const double w1 = root_c1_ / lambda, w2 = root_c2_ / lambda;
    const double upper_area = w1 * (1 - std::cos(a)), lower_area = joint * w2 * std::sin(b);
    const double squares = (upper.thickness / 2 - w1 / 4 * std::sin(2 * a)) / upper.modulus +
                           joint * joint * (lower.thickness / 2 + w2 / 4 * std::sin(2 * b)) / lower.modulus;
    const double amplitude = (upper_area / upper.modulus + lower_area / lower.modulus) / squares;
    terms_.push_back({lambda, amplitude, joint, upper_area, lower_area});
  }
}

double TwoLayers::pressure(double depth, double time) const {
  double sum = 0;
  for (const Term& t : terms_) {
    const double x =
        depth < upper_.thickness
            ? std::sin(t.lambda * depth / root_c1_)
            : t.at_joint * std::cos(t.lambda * (upper_.thickness + lower_.thickness - depth) / root_c2_);
    sum += t.amplitude * x * std::exp(-t.lambda * t.lambda * time);
  }
  return sum;
}

double TwoLayers::degree(double time) const {
  double left = 0;
  for (const Term& t : terms_)
    left += t.amplitude * (t.upper_area / upper_.modulus + t.lower_area / lower_.modulus) *
            std::exp(-t.lambda * t.lambda * time);
  return 1 - left / (upper_.thickness / upper_.modulus + lower_.thickness / lower_.modulus);
}

Mandel::Mandel(double nu) : nu_(nu) {
  const double slope = (1 - nu) / (0.5 - nu);
  for (int n = 0; n < many; ++n)
    roots_.push_back(find_root([&](double b) { return std::sin(b) - slope * b * std::cos(b); },
                               n == 0 ? 0.1 : n * pi, (n + 0.5) * pi));
}

double Mandel::pressure(double x, double factor) const {
  double sum = 0;
  for (const double b : roots_)
    sum += std::sin(b) / (b - std::sin(b) * std::cos(b)) * (std::cos(b * x) - std::cos(b)) *
           std::exp(-b * b * factor);
  return sum;
}

/// No total stress across, and the same vertical strain everywhere.
double Mandel::vertical_stress(double x, double factor) const {
  return ((1 - 2 * nu_) * pressure(x, factor) + strain(factor)) / (1 - nu_);
}

double Mandel::strain(double factor) const {
  double sum = 0;
  for (const double b : roots_)
    sum += std::sin(b) * std::cos(b) / (b - std::sin(b) * std::cos(b)) * std::exp(-b * b * factor);
  return 1 - nu_ - sum;
}

}  // namespace porosph
