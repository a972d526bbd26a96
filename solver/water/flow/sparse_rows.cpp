#include "solver/water/flow/sparse_rows.hpp"

#include <cmath>

#include "solver/space/parallel.hpp"

namespace porosph {
namespace {

using Vector = std::vector<double>;

double dot(std::span<const double> x, std::span<const double> y) {
  return deterministic_sum(x.size(), [&](std::size_t i) { return x[i] * y[i]; });
}

template <class Value>
void fill(std::span<double> out, Value&& value) {
#pragma omp parallel for schedule(static) if (out.size() > 4096)
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = value(i);
}

Vector residual_of(const SparseRows& a, std::span<const double> b, std::span<const double> x) {
  Vector r(b.size());
  a.multiply(x, r);
  fill(r, [&](std::size_t i) { return b[i] - r[i]; });
  return r;
}

}  // namespace

void SparseRows::multiply(std::span<const double> x, std::span<double> out) const {
#pragma omp parallel for schedule(static) if (size() > 4096)
  for (std::size_t i = 0; i < size(); ++i) {
    double sum = diagonal[i] * x[i];
    for (std::int32_t k = begin[i]; k < begin[i + 1]; ++k) sum += value[k] * x[column[k]];
    out[i] = sum;
  }
}

KrylovResult conjugate_gradients(const SparseRows& a, std::span<const double> b, std::span<double> x,
                                 double tolerance, int most_iterations, ToleranceOf of) {
  const std::size_t n = b.size();
  Vector r = residual_of(a, b, x), z(n), image(n);
  const double size = std::sqrt(dot(r, r));
  const double start = of == ToleranceOf::start ? size : std::sqrt(dot(b, b));
  KrylovResult result{.iterations = 0, .residual = 1, .converged = size <= tolerance * start};
  const auto precondition = [&] { fill(z, [&](std::size_t i) { return r[i] / a.diagonal[i]; }); };
  precondition();
  Vector direction = z;
  double slope = dot(r, z);
  while (!result.converged && result.iterations < most_iterations) {
    a.multiply(direction, image);
    const double curvature = dot(direction, image);
    if (!(curvature > 0)) return result;
    const double step = slope / curvature;
    fill(x, [&](std::size_t i) { return x[i] + step * direction[i]; });
    fill(r, [&](std::size_t i) { return r[i] - step * image[i]; });
    ++result.iterations;
    result.residual = std::sqrt(dot(r, r)) / start;
    result.converged = result.residual <= tolerance;
    precondition();
    const double next = dot(r, z);
    fill(direction, [&](std::size_t i) { return z[i] + next / slope * direction[i]; });
    slope = next;
  }
  return result;
}

KrylovResult bicgstab(const SparseRows& a, std::span<const double> b, std::span<double> x, double tolerance,
                      int most_iterations) {
  const std::size_t n = b.size();
  Vector r = residual_of(a, b, x), shadow = r, p = r, scaled(n), v(n), s(n), scaled_s(n), t(n);
  const double start = std::sqrt(dot(r, r));
  KrylovResult result{.iterations = 0, .residual = 1, .converged = start == 0};
  double rho = dot(shadow, r);
  while (!result.converged && result.iterations < most_iterations) {
    fill(scaled, [&](std::size_t i) { return p[i] / a.diagonal[i]; });
    a.multiply(scaled, v);
    const double alpha = rho / dot(shadow, v);
    fill(s, [&](std::size_t i) { return r[i] - alpha * v[i]; });
    fill(scaled_s, [&](std::size_t i) { return s[i] / a.diagonal[i]; });
    a.multiply(scaled_s, t);
    const double squared = dot(t, t), omega = squared > 0 ? dot(t, s) / squared : 0;
    fill(x, [&](std::size_t i) { return x[i] + alpha * scaled[i] + omega * scaled_s[i]; });
    fill(r, [&](std::size_t i) { return s[i] - omega * t[i]; });
    ++result.iterations;
    result.residual = std::sqrt(dot(r, r)) / start;
    if (!std::isfinite(result.residual)) return result;
    result.converged = result.residual <= tolerance;
    const double next = dot(shadow, r), beta = next / rho * alpha / omega;
    if (!std::isfinite(beta)) return result;
    fill(p, [&](std::size_t i) { return r[i] + beta * (p[i] - omega * v[i]); });
    rho = next;
  }
  return result;
}

}  // namespace porosph
